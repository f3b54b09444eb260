#pragma once

// Internal: finds triangles seen from above.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.h"

namespace pleinair::content {

/// A rectangle of the horizontal plane, metres.
struct PlanBox {
  Vec2 min, max;

  void Include(Vec2 point);
  void Include(const PlanBox& other);
};

/// A tree of rectangles, each halved at the median of its longer side.
///
/// No uniform grid: triangles of a terrain may be 10⁴ times as large as those of a railing beside
/// them, and a grid of either size is slow for the other.
class PlanTree {
 public:
  explicit PlanTree(std::span<const PlanBox> boxes);

  /// Calls `visit(number)` once for each box that the segment a, b meets or passes within
  /// `margin_m`. Boxes near the corner of a box may be visited although they are missed.
  template <typename Visit>
  void VisitAlong(Vec2 a, Vec2 b, double margin_m, const Visit& visit) const {
    if (nodes_.empty()) return;
    const Vec2 way = b - a;
    const Vec2 middle = (a + b) * 0.5;
    const Vec2 half{std::fabs(way.x) * 0.5, std::fabs(way.y) * 0.5};
    const auto meets = [&](const PlanBox& box) {
      const Vec2 extent = (box.max - box.min) * 0.5 + Vec2{margin_m, margin_m};
      const Vec2 apart = (box.min + box.max) * 0.5 - middle;
      if (std::fabs(apart.x) > extent.x + half.x || std::fabs(apart.y) > extent.y + half.y) {
        return false;
      }
      // The normal of the segment as an axis that separates them.
      return std::fabs(way.x * apart.y - way.y * apart.x) <=
             std::fabs(way.x) * extent.y + std::fabs(way.y) * extent.x;
    };
    std::array<std::uint32_t, kMaxDepth + 1> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t at = stack[--depth];
      const Node& node = nodes_[at];
      if (!meets(node.box)) continue;
      if (node.count == 0) {
        stack[depth++] = node.first;
        stack[depth++] = at + 1;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(order_[i]);
    }
  }

 private:
  // Halving 2³² boxes ends after 32 levels.
  static constexpr std::size_t kMaxDepth = 40;

  struct Node {
    PlanBox box;
    std::uint32_t first = 0;  // Of a leaf: in order_. Else the second child; the first one follows.
    std::uint32_t count = 0;  // Boxes of a leaf; 0: an inner node.
  };
  void Build(std::span<const PlanBox> boxes, std::uint32_t first, std::uint32_t count);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace pleinair::content
