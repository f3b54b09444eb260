#include "content/flow/placement_holes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pleinair::content {
namespace {

constexpr double kLatticeStep = 0.25;  // Of the spacing.
constexpr double kMaxNodes = 1 << 28;
// Distances beyond are taken for equal, so that a point of a line has few nodes to update.
constexpr double kRadiusInPlane = 2.5, kRadiusInSpace = 1.3;  // Of the spacing.

}  // namespace

Result<PlacementHoles> PlacementHoles::Create(const Box& box, double spacing_m, bool plane,
                                              const std::function<bool(const Vec3&)>& has_flow) {
  PlacementHoles holes;
  holes.low_ = box.min;
  holes.spacing_m_ = spacing_m;
  holes.step_m_ = kLatticeStep * spacing_m;
  holes.radius_m_ = (plane ? kRadiusInPlane : kRadiusInSpace) * spacing_m;
  const Vec3 size = box.max - box.min;
  const std::array<double, 3> extents{size.x, size.y, size.z};
  double nodes = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double count = std::floor(extents[a] / holes.step_m_) + 1.0;
    nodes *= count;
    if (!(nodes <= kMaxNodes)) {
      return InputError("", "the spacing is too small for the domain",
                        "use a larger spacing, or cut out the part that you need");
    }
    holes.counts_[a] = static_cast<int>(count);
  }
  holes.distance_m_.resize(static_cast<std::size_t>(nodes));
  for (std::size_t i = 0; i < holes.distance_m_.size(); ++i) {
    holes.distance_m_[i] = has_flow(holes.Node(i)) ? static_cast<float>(holes.radius_m_) : 0.0F;
  }
  return holes;
}

Vec3 PlacementHoles::Node(std::size_t number) const {
  const auto n0 = static_cast<std::size_t>(counts_[0]), n1 = static_cast<std::size_t>(counts_[1]);
  return low_ + Vec3{static_cast<double>(number % n0), static_cast<double>(number / n0 % n1),
                     static_cast<double>(number / n0 / n1)} *
                    step_m_;
}

void PlacementHoles::Add(const Vec3& point) {
  const std::array<double, 3> at{point.x - low_.x, point.y - low_.y, point.z - low_.z};
  std::array<int, 3> first{}, last{};
  for (std::size_t a = 0; a < 3; ++a) {
    first[a] =
        std::clamp(static_cast<int>(std::ceil((at[a] - radius_m_) / step_m_)), 0, counts_[a]);
    last[a] =
        std::clamp(static_cast<int>(std::floor((at[a] + radius_m_) / step_m_)), -1, counts_[a] - 1);
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const double dx = x * step_m_ - at[0], dy = y * step_m_ - at[1], dz = z * step_m_ - at[2];
        const auto away_m = static_cast<float>(std::sqrt(dx * dx + dy * dy + dz * dz));
        float& distance_m =
            distance_m_[static_cast<std::size_t>(x) +
                        static_cast<std::size_t>(counts_[0]) *
                            (static_cast<std::size_t>(y) +
                             static_cast<std::size_t>(counts_[1]) * static_cast<std::size_t>(z))];
        distance_m = std::min(distance_m, away_m);
      }
    }
  }
}

std::optional<Vec3> PlacementHoles::TakeLargest() {
  if (!is_filled_) {
    for (std::size_t i = 0; i < distance_m_.size(); ++i) {
      if (static_cast<double>(distance_m_[i]) > spacing_m_) largest_.emplace(distance_m_[i], i);
    }
    is_filled_ = true;
  }
  while (!largest_.empty()) {
    const auto [distance_m, node] = largest_.top();
    largest_.pop();
    const float current_m = distance_m_[node];
    if (static_cast<double>(current_m) <= spacing_m_) continue;
    if (current_m < distance_m) {
      largest_.emplace(current_m, node);
      continue;
    }
    distance_m_[node] = 0.0F;  // Tried.
    return Node(node);
  }
  return std::nullopt;
}

}  // namespace pleinair::content
