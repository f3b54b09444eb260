#include "compositor/lens/stop_places.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace pleinair::compositor {
namespace {

Vec2 OnCircle(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

/// The stop's border at a share of its circumference from the first corner.
Vec2 OnBorder(const LensStop& stop, double share) {
  if (stop.blades == 0) return OnCircle(2.0 * std::numbers::pi * share);
  const double side = share * stop.blades, first = std::floor(side);
  const auto corner = [&](double i) {
    return OnCircle(stop.rotation_rad + 2.0 * std::numbers::pi * i / stop.blades);
  };
  const Vec2 a = corner(first), b = corner(first + 1.0);
  return a + (b - a) * (side - first);
}

}  // namespace

std::vector<Vec2> StopPlaces(const LensStop& stop, int count) {
  constexpr double kGoldenShare = 2.0 - std::numbers::phi;  // Share of a full turn.
  std::vector<Vec2> places;
  places.reserve(static_cast<std::size_t>(count));
  Vec2 mean{0.0, 0.0};
  for (int i = 0; i < count; ++i) {
    const double turns = i * kGoldenShare;
    // The area within a scaled border grows with the square of its scale.
    places.push_back(OnBorder(stop, turns - std::floor(turns)) * std::sqrt((i + 0.5) / count));
    mean = mean + places.back() * (1.0 / count);
  }
  for (Vec2& place : places) place = place - mean;
  return places;
}

}  // namespace pleinair::compositor
