#include "tracker/quads/quad_box.h"

#include <algorithm>
#include <cmath>

namespace pleinair::tracker {
namespace {

/// Bounding boxes that differ by less than this share on each side belong to one square, …
constexpr double kSameBox = 0.04;
/// … and up to this many pixels of the reduced image. What thresholds remove at the corners of a
/// rotated square does not grow with its size.
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
