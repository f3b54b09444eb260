#include "app/window/north_pole.h"

#include <cmath>

#include "scene/marker_heading.h"

namespace pleinair::app {
namespace {

// Sine of the min. sun elevation whose shadow tip is usable.
constexpr double kMinSunSine = 0.02;

/// Angle of a horizontal direction from the marker's heading, clockwise seen from above.
double ClockwiseFromHeading(const scene::MarkerDescription& marker, Vec3 direction) {
  // +y of a lying marker, −z of an upright one.
  return std::atan2(direction.x, marker.upright ? -direction.z : direction.y);
}

}  // namespace

Vec3 UpOf(const scene::MarkerDescription& marker) {
  return marker.upright ? Vec3{0.0, 1.0, 0.0} : Vec3{0.0, 0.0, 1.0};
}

std::optional<Vec3> NorthPole::ShadowTip(const scene::MarkerDescription& marker,
                                         Vec3 to_sun_in_world) const {
  if (to_sun_in_world.z < kMinSunSine) return std::nullopt;
  const Vec3 to_sun = scene::MarkerFromWorld(marker) * to_sun_in_world;
  const Vec3 top = foot + UpOf(marker) * height_m;
  return top - to_sun * (height_m / to_sun_in_world.z);
}

std::optional<double> HeadingForShadow(const scene::MarkerDescription& marker,
                                       const NorthPole& pole, Vec3 towards, Vec3 to_sun_in_world) {
  const Vec3 up = UpOf(marker);
  const Vec3 offset = towards - pole.foot;
  const Vec3 level = offset - up * Dot(offset, up);
  if (to_sun_in_world.z < kMinSunSine || Norm(level) < 1e-3) return std::nullopt;
  const double shadow_azimuth = std::atan2(-to_sun_in_world.x, -to_sun_in_world.y);
  const double heading = (shadow_azimuth - ClockwiseFromHeading(marker, level)) / kRadiansPerDegree;
  return heading - 360.0 * std::floor(heading / 360.0);
}

}  // namespace pleinair::app
