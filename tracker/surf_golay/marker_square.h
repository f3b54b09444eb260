#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <algorithm>
#include <array>

#include "base/vector.h"
#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {

/// Converts from the black square in half edges (x right, y up, origin at its centre) to modules of
/// the marker, from its top-left corner, y down.
inline Vec2 ModulesOfUnit(Vec2 unit) {
  constexpr double kHalf = 0.5 * sg::kEdge, kMiddle = 0.5 * sg::kModules;
  return {kMiddle + kHalf * unit.x, kMiddle - kHalf * unit.y};
}

/// The square's corners in undistorted pixels: clockwise from top-left on the upright marker.
inline std::array<Vec2, 4> UndistortedSquareCorners(const Mat3& modules_from_undistorted) {
  const Mat3 undistorted_from_modules = Adjugate(modules_from_undistorted);
  std::array<Vec2, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] = Apply(undistorted_from_modules, ModulesOfUnit(kSquareCorners[i]));
  }
  return corners;
}

/// The inverse of UndistortedSquareCorners().
inline Mat3 ModulesFromSquareCorners(const std::array<Vec2, 4>& corners_undistorted) {
  constexpr double kHalf = 0.5 * sg::kEdge, kMiddle = 0.5 * sg::kModules;
  constexpr Mat3 kModulesFromUnit{{kHalf, 0, kMiddle, 0, -kHalf, kMiddle, 0, 0, 1}};
  return kModulesFromUnit * Adjugate(HomographyToQuad(corners_undistorted));
}

inline double LongestSide(const std::array<Vec2, 4>& corners) {
  double longest = 0.0;
  for (int i = 0; i < 4; ++i) longest = std::max(longest, Norm(corners[i] - corners[(i + 1) % 4]));
  return longest;
}

/// Largest distance of corresponding corners.
inline double MaxCornerDistance(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  double farthest = 0.0;
  for (int i = 0; i < 4; ++i) farthest = std::max(farthest, Norm(a[i] - b[i]));
  return farthest;
}

}  // namespace pleinair::tracker
