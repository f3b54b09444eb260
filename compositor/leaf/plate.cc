#include "compositor/leaf/plate.h"

#include <array>
#include <cmath>
#include <numbers>

namespace pleinair::compositor {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;

/// Specific absorption of red, green and blue: Miao et al. 2016, table of section 2.
struct PlateAbsorption {
  double chlorophyll, carotenoids, brown, dry;
};
constexpr std::array<PlateAbsorption, 3> kPlateAbsorption = {{
    {0.05914, 0.0, 0.1572, 2.3},
    {0.01221, 0.0073, 0.3568, 2.3},
    {0.0716, 0.168, 0.4912, 1.481},
}};

/// E₁(k) + γ + ln k for 0 ≤ k ≤ 1: −Σ (−k)ⁿ / (n n!).
double ExponentialIntegralSeries(double k) {
  constexpr int kTerms = 17;
  static const std::array<double, kTerms + 1> kCoefficients = [] {
    std::array<double, kTerms + 1> values{};
    double factorial = 1.0;
    for (int n = 1; n <= kTerms; ++n) {
      factorial *= n;
      values[n] = (n % 2 == 1 ? 1.0 : -1.0) / (n * factorial);
    }
    return values;
  }();
  double sum = 0.0;
  for (int n = kTerms; n > 0; --n) sum = (sum + kCoefficients[n]) * k;
  return sum;
}

}  // namespace

double ConeTransmittance(Radians cone, double refractive_index) {
  const double n = refractive_index, n2 = n * n;
  const double sine = std::sin(cone.value());
  const double s2 = sine * sine;
  if (s2 < 1e-12) return 4.0 * n / ((n + 1.0) * (n + 1.0));
  const double sum = n2 + 1.0, difference = n2 - 1.0;
  const double a = (n + 1.0) * (n + 1.0) / 2.0;
  const double k = -difference * difference / 4.0;
  const double half = s2 - sum / 2.0;
  // At 90° the root is of zero; rounding makes it negative.
  const double b = std::sqrt(std::fmax(half * half + k, 0.0)) - half;
  const double perpendicular =
      (k * k / (6.0 * b * b * b) + k / b - b / 2.0) - (k * k / (6.0 * a * a * a) + k / a - a / 2.0);
  const double square = difference * difference, sum3 = sum * sum * sum;
  const double at_b = 2.0 * sum * b - square, at_a = 2.0 * sum * a - square;
  const double parallel =
      -2.0 * n2 * (b - a) / (sum * sum) - 2.0 * n2 * sum * std::log(b / a) / square +
      n2 * (1.0 / b - 1.0 / a) / 2.0 +
      16.0 * n2 * n2 * (n2 * n2 + 1.0) * std::log(at_b / at_a) / (sum3 * square) +
      16.0 * n2 * n2 * n2 * (1.0 / at_b - 1.0 / at_a) / sum3;
  return (perpendicular + parallel) / (2.0 * s2);
}

double LayerTransmittance(double k) {
  if (k <= 0.0) return 1.0;
  const double left = std::exp(-k);
  if (k <= 1.0) {
    const double e1 = ExponentialIntegralSeries(k) - std::numbers::egamma - std::log(k);
    return (1.0 - k) * left + k * k * e1;
  }
  const double over = (((k + 8.5733287401) * k + 18.0590169730) * k + 8.6347608925) * k;
  const double under = (((k + 9.5733223454) * k + 25.6329561486) * k + 21.0996530827) * k;
  const double scaled_e1 = (over + 0.2677737343) / (under + 3.9584969228);  // k e^k E₁(k).
  return left * (1.0 - k * (1.0 - scaled_e1));
}

PlateSurface PlateSurfaceOf(Radians cone, double refractive_index) {
  return {ConeTransmittance(cone, refractive_index),
          ConeTransmittance(Radians(kRightAngle), refractive_index),
          refractive_index * refractive_index};
}

LeafColors PlateColors(const scene::Leaf& leaf, double thickness) {
  const scene::LeafContents& contents = leaf.contents;
  std::array<LeafOptics, 3> channels;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const PlateAbsorption& absorption = kPlateAbsorption[c];
    const double k = (absorption.chlorophyll * contents.chlorophyll_ug_cm2 +
                      absorption.carotenoids * contents.carotenoids_ug_cm2 +
                      absorption.brown * contents.brown + absorption.dry * contents.dry_g_cm2) *
                     thickness / contents.structure;
    channels[c] =
        PlateOptics(PlateSurfaceOf(Radians(0.0), leaf.refractive_index[c]), LayerTransmittance(k));
  }
  return {{channels[0].reflectance, channels[1].reflectance, channels[2].reflectance},
          {channels[0].transmittance, channels[1].transmittance, channels[2].transmittance}};
}

}  // namespace pleinair::compositor
