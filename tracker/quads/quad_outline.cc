#include "tracker/quads/quad_outline.h"

#include <algorithm>
#include <climits>
#include <cmath>

namespace pleinair::tracker {
namespace {

/// Minimum area of the quadrilateral relative to the hull, for squares with rounded corners.
constexpr double kMinShareOfHull = 0.78;
/// Minimum share of dark pixels in the hull. The border alone is 0.36 of the square; at the
/// smallest size, with bright surroundings blurred into it, half of that.
constexpr double kMinFill = 0.16;

/// Twice the area of a triangle, positive if clockwise in the image.
template <class P>
auto Twice(const P& a, const P& b, const P& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Intersection of the lines a + s·u and b + t·v; nullopt if they are parallel.
std::optional<Vec2> Intersection(Vec2 a, Vec2 u, Vec2 b, Vec2 v) {
  const double cross = u.x * v.y - u.y * v.x;
  if (std::fabs(cross) < 1e-3 * Norm(u) * Norm(v)) return std::nullopt;
  const double s = ((b.x - a.x) * v.y - (b.y - a.y) * v.x) / cross;
  return a + u * s;
}

/// Moves the sides outwards by half a pixel, because hull vertices are pixel centres.
std::optional<std::array<Vec2, 4>> Grown(const std::array<Vec2, 4>& quad) {
  std::array<Vec2, 4> from, along;
  for (int i = 0; i < 4; ++i) {
    along[i] = quad[(i + 1) % 4] - quad[i];
    const double length = Norm(along[i]);
    from[i] = quad[i] + Vec2{along[i].y, -along[i].x} * (0.5 / length);
  }
  std::array<Vec2, 4> grown;
  for (int i = 0; i < 4; ++i) {
    const auto corner = Intersection(from[(i + 3) % 4], along[(i + 3) % 4], from[i], along[i]);
    if (!corner) return std::nullopt;
    grown[i] = *corner;
  }
  return grown;
}

}  // namespace

void QuadOutline::BuildHull(std::span<const DarkRun> runs, const DarkComponent& component) {
  const int rows = component.max_y - component.min_y + 1;
  left_.assign(rows, INT_MAX);
  right_.assign(rows, INT_MIN);
  for (int i = component.first_run; i >= 0; i = runs[i].next) {
    const DarkRun& run = runs[i];
    const int row = run.y - component.min_y;
    left_[row] = std::min(left_[row], run.begin);
    right_[row] = std::max(right_[row], run.end - 1);
  }
  // Andrew's monotone chain, once down the right and once up the left: the rows are in order.
  hull_.clear();
  const auto extend = [&](std::size_t first, Vertex v) {
    while (hull_.size() >= first + 2 && Twice(hull_[hull_.size() - 2], hull_.back(), v) <= 0) {
      hull_.pop_back();
    }
    hull_.push_back(v);
  };
  for (int row = 0; row < rows; ++row) extend(0, {right_[row], row});
  const std::size_t turn = hull_.size();
  for (int row = rows - 1; row >= 0; --row) extend(turn, {left_[row], row});
}

std::optional<std::array<Vec2, 4>> QuadOutline::Fit(std::span<const DarkRun> runs,
                                                    const DarkComponent& component,
                                                    double min_side_px) {
  BuildHull(runs, component);
  if (hull_.size() < 4) return std::nullopt;
  long twice_area = 0;
  for (std::size_t i = 2; i < hull_.size(); ++i) {
    twice_area += Twice(hull_[0], hull_[i - 1], hull_[i]);
  }
  const double hull_area = 0.5 * static_cast<double>(twice_area);
  if (component.area < kMinFill * hull_area) return std::nullopt;

  // Drops the vertex with the smallest loss of area until four are left or too much is lost.
  const auto cut_at = [&](std::size_t i) {
    const std::size_t n = hull_.size();
    return Twice(hull_[i == 0 ? n - 1 : i - 1], hull_[i], hull_[i + 1 == n ? 0 : i + 1]);
  };
  cuts_.resize(hull_.size());
  for (std::size_t i = 0; i < hull_.size(); ++i) cuts_[i] = cut_at(i);
  double may_go = (1.0 - kMinShareOfHull) * static_cast<double>(twice_area);
  while (hull_.size() > 4) {
    const auto least = std::min_element(cuts_.begin(), cuts_.end());
    may_go -= *least;
    if (may_go < 0.0) return std::nullopt;
    const std::ptrdiff_t i = least - cuts_.begin();
    hull_.erase(hull_.begin() + i);
    cuts_.erase(least);
    const std::size_t n = hull_.size(), after = static_cast<std::size_t>(i) % n;
    cuts_[after] = cut_at(after);
    cuts_[(after + n - 1) % n] = cut_at((after + n - 1) % n);
  }

  std::array<Vec2, 4> quad;
  for (int i = 0; i < 4; ++i) {
    quad[i] = {static_cast<double>(hull_[i].x), static_cast<double>(hull_[i].y + component.min_y)};
  }
  for (int i = 0; i < 4; ++i) {
    if (Norm(quad[(i + 1) % 4] - quad[i]) + 1.0 < min_side_px) return std::nullopt;
    // Nearly straight vertices are not corners of a marker.
    if (Twice(quad[(i + 3) % 4], quad[i], quad[(i + 1) % 4]) <
        0.05 * Norm(quad[i] - quad[(i + 3) % 4]) * Norm(quad[(i + 1) % 4] - quad[i])) {
      return std::nullopt;
    }
  }
  return Grown(quad);
}

}  // namespace pleinair::tracker
