#include "tracker/quads/quad_box.h"

#include <algorithm>
#include <cmath>

namespace pleinair::tracker {
namespace {

/// Boxes around squares that differ by so little on each side, as a share, are of one, …
constexpr double kSameBox = 0.04;
/// … up to so many pixels of the reduced image: what thresholds take off the corners of a turned
/// square does not grow with it.
constexpr double kLostCorner_px = 2.5;

}  // namespace

bool FillsBoxOf(const Quad& quad, const DarkComponent& component, int scale) {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const Vec2& corner : quad.corners_px) {
    left = std::min(left, corner.x);
    right = std::max(right, corner.x);
    top = std::min(top, corner.y);
    bottom = std::max(bottom, corner.y);
  }
  const double tolerance =
      std::min(scale + kSameBox * std::max(right - left, bottom - top), kLostCorner_px * scale);
  const auto edge = [&](int pixel) { return pixel * scale - 0.5; };
  return std::fabs(edge(component.min_x) - left) < tolerance &&
         std::fabs(edge(component.max_x + 1) - right) < tolerance &&
         std::fabs(edge(component.min_y) - top) < tolerance &&
         std::fabs(edge(component.max_y + 1) - bottom) < tolerance;
}

}  // namespace pleinair::tracker
