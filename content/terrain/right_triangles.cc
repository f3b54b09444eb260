#include "content/terrain/right_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>

#include "base/parallel_for.h"

namespace pleinair::content {
namespace {

constexpr float kHole = std::numeric_limits<float>::infinity();

}  // namespace

RightTriangles::RightTriangles(const Image<float>& heights) : heights_(heights) {
  const int cells = std::max(heights.width(), heights.height()) - 1;
  while (side_ < cells) side_ *= 2;
  // Beside the grid are holes. Their bounds need no memory.
  bounds_ = Image<float>(heights.width(), heights.height());
  for (int side = 2; side <= side_; side *= 2) {
    BoundSides(side);
    BoundSquares(side);
  }
}

float RightTriangles::HeightAt(int x, int y) const {
  const bool is_inside = x >= 0 && y >= 0 && x < heights_.width() && y < heights_.height();
  return is_inside ? heights_(x, y) : std::numeric_limits<float>::quiet_NaN();
}

float RightTriangles::TwistOf(int x, int y) const {
  const float twist =
      HeightAt(x, y) + HeightAt(x + 1, y + 1) - HeightAt(x + 1, y) - HeightAt(x, y + 1);
  return std::isfinite(twist) ? 0.25F * std::fabs(twist) : kHole;
}

void RightTriangles::SetBound(int x, int y, float middle_error, float halves) {
  if (x >= heights_.width() || y >= heights_.height()) return;
  bounds_(x, y) = std::isfinite(middle_error) ? std::fabs(middle_error) + halves : kHole;
}

/// Triangles whose longest side is a side of a square of `side` cells: below and above it, or left
/// and right of it.
void RightTriangles::BoundSides(int side) {
  const int half = side / 2;
  // Bounds of the halves, whose longest sides are diagonals of squares of half the side.
  const auto square = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= side_ || y >= side_) return 0.0F;  // Beside the root.
    if (half == 1) return TwistOf(x, y);
    const int cx = x + half / 2, cy = y + half / 2;
    return cx < heights_.width() && cy < heights_.height() ? bounds_(cx, cy) : kHole;
  };
  const auto rows = static_cast<std::size_t>(heights_.height());
  ParallelForBlocks(rows, 64, [&](std::size_t first, std::size_t last) {
    for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
      const bool is_level = y % side == 0, is_upright = y % side == half;
      if (!is_level && !is_upright) continue;
      for (int x = is_level ? half : 0; x < heights_.width(); x += side) {
        const float ends = is_level ? HeightAt(x - half, y) + HeightAt(x + half, y)
                                    : HeightAt(x, y - half) + HeightAt(x, y + half);
        const float halves = std::max(std::max(square(x - half, y - half), square(x, y - half)),
                                      std::max(square(x - half, y), square(x, y)));
        SetBound(x, y, heights_(x, y) - 0.5F * ends, halves);
      }
    }
  });
}

/// The two halves of squares of `side` cells.
void RightTriangles::BoundSquares(int side) {
  const int half = side / 2;
  const auto bound = [&](int x, int y) {
    return x < heights_.width() && y < heights_.height() ? bounds_(x, y) : kHole;
  };
  for (int y = half; y < heights_.height(); y += side) {
    for (int x = half; x < heights_.width(); x += side) {
      const bool rises = ((x - half) / side + (y - half) / side) % 2 == 0;
      const float ends = rises ? HeightAt(x - half, y - half) + HeightAt(x + half, y + half)
                               : HeightAt(x + half, y - half) + HeightAt(x - half, y + half);
      const float halves = std::max(std::max(bound(x, y - half), bound(x, y + half)),
                                    std::max(bound(x - half, y), bound(x + half, y)));
      SetBound(x, y, heights_(x, y) - 0.5F * ends, halves);
    }
  }
}

struct RightTriangles::Emission {
  float max_error = 0.0F;
  const std::function<void(const GridTriangle&)>& emit;
  float largest_bound = 0.0F;

  void Emit(const GridTriangle& triangle, float bound) {
    largest_bound = std::max(largest_bound, bound);
    emit(triangle);
  }
};

void RightTriangles::EmitHalf(GridCorner left, GridCorner right, GridCorner apex,
                              Emission* emission) const {
  if (std::abs(left.x - right.x) == 1 && std::abs(left.y - right.y) == 1) {  // Half a cell.
    const float twist = TwistOf(std::min(left.x, right.x), std::min(left.y, right.y));
    if (std::isfinite(twist)) emission->Emit({left, right, apex}, twist);
    return;
  }
  const int lowest_x = std::min({left.x, right.x, apex.x});
  const int lowest_y = std::min({left.y, right.y, apex.y});
  if (lowest_x >= heights_.width() - 1 || lowest_y >= heights_.height() - 1) return;
  const GridCorner middle{(left.x + right.x) / 2, (left.y + right.y) / 2};
  const bool is_inside = middle.x < heights_.width() && middle.y < heights_.height();
  if (is_inside && bounds_(middle.x, middle.y) <= emission->max_error) {
    emission->Emit({left, right, apex}, bounds_(middle.x, middle.y));
    return;
  }
  EmitHalf(apex, left, middle, emission);
  EmitHalf(right, apex, middle, emission);
}

float RightTriangles::Emit(float max_error,
                           const std::function<void(const GridTriangle&)>& emit) const {
  Emission emission{max_error, emit};
  const GridCorner origin{0, 0}, far{side_, side_};
  EmitHalf(far, origin, {side_, 0}, &emission);
  EmitHalf(origin, far, {0, side_}, &emission);
  return emission.largest_bound;
}

}  // namespace pleinair::content
