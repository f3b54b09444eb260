#pragma once

#include <array>
#include <functional>

#include "base/image.h"

namespace pleinair::content {

/// A corner of a grid's cells, by column and row.
struct GridCorner {
  int x = 0, y = 0;
  bool operator==(const GridCorner&) const = default;
};

/// Three corners of a grid, counter-clockwise where x points right and y up.
using GridTriangle = std::array<GridCorner, 3>;

/// The triangles of a grid of heights, no more than an error needs: a right-triangulated irregular
/// network (W. Evans, D. Kirkpatrick, G. Townsend: Right-triangulated irregular networks.
/// Algorithmica 30, 2001). Each triangle is half of another, which it halves by the middle of the
/// longest side. Neighbours share whole sides, so that there are no cracks.
///
/// A bound on the error of a triangle is the height of the middle over the longest side, plus the
/// larger bound of its halves. The surface is within that bound of the halves, and these are within
/// that height of the triangle. Such nested bounds are those of P. Lindstrom, V. Pascucci:
/// Visualization of large terrains made easy. IEEE Visualization 2001. The surface is bilinear
/// within a cell. A cell with the twist t = z00 + z11 − z10 − z01 differs from its two halves by
/// |t| / 4 at most.
///
/// Cells with a corner that is not a number are holes.
class RightTriangles {
 public:
  /// `heights`: one channel, at least 2 by 2; must outlive this object.
  explicit RightTriangles(const Image<float>& heights);

  /// Calls `emit` for each triangle of a network whose error is at most `max_error`, where that is
  /// possible: the smallest triangles are halves of cells. Returns the largest bound among the
  /// emitted ones, which is above `max_error` where cells are twisted more. The same order whatever
  /// the machine.
  float Emit(float max_error, const std::function<void(const GridTriangle&)>& emit) const;

 private:
  float HeightAt(int x, int y) const;
  /// Error of the halves of a cell; infinite for a hole.
  float TwistOf(int x, int y) const;
  void SetBound(int x, int y, float middle_error, float halves);
  void BoundSides(int side);
  void BoundSquares(int side);
  struct Emission;
  void EmitHalf(GridCorner left, GridCorner right, GridCorner apex, Emission* emission) const;

  const Image<float>& heights_;
  int side_ = 1;         // Cells along a side of the square around the grid, a power of two.
  Image<float> bounds_;  // The larger one of the triangles whose longest side has this middle.
};

}  // namespace pleinair::content
