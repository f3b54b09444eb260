#pragma once

// Internal: between the .cc files of this module; not installed.

#include <algorithm>
#include <array>

#include "base/vector.h"
#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {

/// From the black square in half edges (x right, y up, origin in its middle) to modules of the
/// print, from its top-left corner, y down.
inline Vec2 ModulesOfUnit(Vec2 unit) {
  constexpr double kHalf = 0.5 * sg::kEdge, kMiddle = 0.5 * sg::kPrint;
  return {kMiddle + kHalf * unit.x, kMiddle - kHalf * unit.y};
}

/// The square's corners in ideal pixels: top-left, then clockwise as the print is read.
inline std::array<Vec2, 4> SquareCornersIdeal(const Mat3& modules_from_ideal) {
  const Mat3 ideal_from_modules = Adjugate(modules_from_ideal);
  std::array<Vec2, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] = Apply(ideal_from_modules, ModulesOfUnit(kSquareCorners[i]));
  }
  return corners;
}

/// The inverse of SquareCornersIdeal.
inline Mat3 ModulesFromSquareCorners(const std::array<Vec2, 4>& corners_ideal) {
  constexpr double kHalf = 0.5 * sg::kEdge, kMiddle = 0.5 * sg::kPrint;
  constexpr Mat3 kModulesFromUnit{{kHalf, 0, kMiddle, 0, -kHalf, kMiddle, 0, 0, 1}};
  return kModulesFromUnit * Adjugate(HomographyToQuad(corners_ideal));
}

inline double LongestSide(const std::array<Vec2, 4>& corners) {
  double longest = 0.0;
  for (int i = 0; i < 4; ++i) longest = std::max(longest, Norm(corners[i] - corners[(i + 1) % 4]));
  return longest;
}

/// The greatest distance of corresponding corners.
inline double FarthestApart(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  double farthest = 0.0;
  for (int i = 0; i < 4; ++i) farthest = std::max(farthest, Norm(a[i] - b[i]));
  return farthest;
}

}  // namespace pleinair::tracker
