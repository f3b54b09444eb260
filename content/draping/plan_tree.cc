#include "content/draping/plan_tree.h"

#include <algorithm>
#include <numeric>

namespace pleinair::content {
namespace {

constexpr std::uint32_t kLeafSize = 4;

}  // namespace

void PlanBox::Include(Vec2 point) { Include(PlanBox{point, point}); }

void PlanBox::Include(const PlanBox& other) {
  min = {std::min(min.x, other.min.x), std::min(min.y, other.min.y)};
  max = {std::max(max.x, other.max.x), std::max(max.y, other.max.y)};
}

PlanTree::PlanTree(std::span<const PlanBox> boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (boxes.empty()) return;
  nodes_.reserve(boxes.size());
  Build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
}

void PlanTree::Build(std::span<const PlanBox> boxes, std::uint32_t first, std::uint32_t count) {
  const std::size_t at = nodes_.size();
  Node node{boxes[order_[first]], first, count};
  for (std::uint32_t i = first; i < first + count; ++i) node.box.Include(boxes[order_[i]]);
  nodes_.push_back(node);
  if (count <= kLeafSize) return;
  const Vec2 size = node.box.max - node.box.min;
  const auto centre = [&](std::uint32_t box) {
    return size.x > size.y ? boxes[box].min.x + boxes[box].max.x
                           : boxes[box].min.y + boxes[box].max.y;
  };
  const auto begin = order_.begin() + first;
  const std::uint32_t half = count / 2;
  // Ties are broken by number, so that the tree is the same with every library.
  std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const double left = centre(a), right = centre(b);
    return left < right || (left == right && a < b);
  });
  Build(boxes, first, half);
  nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[at].count = 0;
  Build(boxes, first + half, count - half);
}

}  // namespace pleinair::content
