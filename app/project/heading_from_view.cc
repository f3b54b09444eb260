#include "app/project/heading_from_view.h"

#include <cmath>

#include "base/units.h"

namespace pleinair::app {

std::optional<double> HeadingFromView(double view_heading_deg,
                                      const Transform<Camera, Marker>& camera_from_marker,
                                      bool upright) {
  constexpr double kSteepest = 0.342;  // Sine of 20°.
  const Direction<Marker> view = camera_from_marker.Inverse() * Direction<Camera>{{0, 0, 1}};
  const double ahead = upright ? -view.xyz.z : view.xyz.y;
  if (std::hypot(view.xyz.x, ahead) < kSteepest) return std::nullopt;
  constexpr double kTurn_deg = 360.0;
  const double heading_deg = view_heading_deg - std::atan2(view.xyz.x, ahead) / kRadiansPerDegree;
  return std::fmod(std::fmod(heading_deg, kTurn_deg) + kTurn_deg, kTurn_deg);
}

}  // namespace pleinair::app
