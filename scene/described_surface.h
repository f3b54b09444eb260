#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"

namespace pleinair::scene {

/// Linear diffuse reflectance of surfaces without a color: dry ground, light stone.
inline constexpr LinearRgb kUsualReflectance{0.35, 0.33, 0.30};

enum class SurfaceKind { kGround, kBox, kWall };

/// A real surface that the scene itself describes, in place of a model file: phantoms without a
/// modeller.
struct DescribedSurface {
  SurfaceKind kind = SurfaceKind::kGround;
  std::string name;  ///< "ground", "box 1", "wall 2".
  /// Convex and plane, at least three corners each, in metres. Boxes: counter-clockwise from
  /// outside.
  std::vector<std::vector<Vec3>> polygons;
  LinearRgb reflectance = kUsualReflectance;
  bool has_color = false;   ///< False: the reflectance is to be measured from the frames.
  bool is_assumed = false;  ///< The user did not write it.
};

/// Level ground as a square around the marker, `below_m` below its surface or, for an upright
/// marker, below its centre.
DescribedSurface GroundSurface(double side_m, double below_m, bool upright);

/// A box by two opposite corners, in any order. Error: no extent in some direction.
Result<DescribedSurface> BoxSurface(Vec3 from, Vec3 to);

/// A wall, seen from both sides, by its corners in order. Errors: fewer than three or more than
/// kMaxWallCorners; corners that coincide, are not in one plane within 1 % of the wall's size, or
/// make a dent.
Result<DescribedSurface> WallSurface(std::vector<Vec3> corners);
inline constexpr std::size_t kMaxWallCorners = 64;

}  // namespace pleinair::scene
