#include "app/bench/traced_rays.h"

#include <cmath>
#include <numbers>

namespace pleinair::app {
namespace {

constexpr int kRays = 4096;

/// A digit-reversed number: the `index`-th of a Halton sequence.
double RadicalInverse(int index, int base) {
  double value = 0.0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) value += digit * (index % base);
  return value;
}

}  // namespace

std::vector<RayPlaces> TracedRays() {
  std::vector<RayPlaces> rays;
  rays.reserve(kRays);
  for (int i = 1; i <= kRays; ++i) {
    const double radius = 0.5 * std::sqrt(RadicalInverse(i, 2));
    const double angle = 2.0 * std::numbers::pi * RadicalInverse(i, 3);
    rays.push_back({radius * std::cos(angle), radius * std::sin(angle), RadicalInverse(i, 5),
                    RadicalInverse(i, 7), RadicalInverse(i, 11) - 0.5});
  }
  return rays;
}

}  // namespace pleinair::app
