#pragma once

#include <array>
#include <cmath>

#include "base/vector.h"

namespace pleinair::tracker {

/// Applies a homography to a point of the plane.
inline Vec2 Apply(const Mat3& homography, Vec2 point) {
  const Vec3 image = homography * Vec3{point.x, point.y, 1.0};
  return {image.x / image.z, image.y / image.z};
}

/// Adjugate: the inverse up to scale, which suffices for homographies.
constexpr Mat3 Adjugate(const Mat3& a) {
  return {{a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1), a(0, 2) * a(2, 1) - a(0, 1) * a(2, 2),
           a(0, 1) * a(1, 2) - a(0, 2) * a(1, 1), a(1, 2) * a(2, 0) - a(1, 0) * a(2, 2),
           a(0, 0) * a(2, 2) - a(0, 2) * a(2, 0), a(0, 2) * a(1, 0) - a(0, 0) * a(1, 2),
           a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0), a(0, 1) * a(2, 0) - a(0, 0) * a(2, 1),
           a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0)}};
}

/// Corners of the marker's square in its own coordinates (x right, y up, half edges): clockwise
/// from top-left on the upright marker.
inline constexpr std::array<Vec2, 4> kSquareCorners{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};

/// Homography that maps kSquareCorners to four points. Heckbert, "Fundamentals of texture mapping
/// and image warping" (1989), section 2.2.3: unit square to quadrilateral.
inline Mat3 HomographyToQuad(const std::array<Vec2, 4>& quad) {
  const Vec2 p0 = quad[0], p1 = quad[1], p2 = quad[2], p3 = quad[3];
  const Vec2 d1 = p1 - p2, d2 = p3 - p2, d3 = p0 - p1 + p2 - p3;
  const double determinant = d1.x * d2.y - d2.x * d1.y;
  const double g = (d3.x * d2.y - d2.x * d3.y) / determinant;
  const double h = (d1.x * d3.y - d3.x * d1.y) / determinant;
  const Mat3 from_unit_square{{p1.x - p0.x + g * p1.x, p3.x - p0.x + h * p3.x, p0.x,
                               p1.y - p0.y + g * p1.y, p3.y - p0.y + h * p3.y, p0.y, g, h, 1.0}};
  // The unit square has its origin at the top-left corner and its second axis downwards.
  constexpr Mat3 kUnitFromMarker{{0.5, 0.0, 0.5, 0.0, -0.5, 0.5, 0.0, 0.0, 1.0}};
  return from_unit_square * kUnitFromMarker;
}

}  // namespace pleinair::tracker
