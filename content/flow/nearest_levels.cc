#include "content/flow/nearest_levels.h"

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "content/flow/field_probe.h"
#include "content/flow/first_step.h"

namespace pleinair::content {
namespace {

constexpr std::uint32_t kLeft = std::numeric_limits<std::uint32_t>::max();
constexpr int kMaxNearestLevels = 30;

}  // namespace

Result<NearestLevels> NearestLevels::Build(const VectorField& field, Seconds frozen_s,
                                           Seconds step_s, int levels) {
  NearestLevels built(field);
  const std::size_t nodes = built.grid_.nodes();
  if (levels < 0 || levels > kMaxNearestLevels || nodes > kMaxNodes) {
    return InputError(
        "",
        "needs " + std::to_string(levels + 1) + " levels of " + std::to_string(nodes) + " points",
        "use fewer steps, or integrate with --method rk45");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::unique_ptr<FieldProbe> probe,
                            MakeFrozenProbe(field, frozen_s));
  std::vector<std::uint32_t> next(nodes, kLeft);
  for (std::size_t node = 0; node < nodes; ++node) {
    const Vec3 after =
        FirstStep(probe.get(), built.grid_.Node(node), frozen_s, step_s, &built.field_reads_);
    if (std::isnan(after.x)) continue;
    const LevelGrid::Nearest nearest = built.grid_.NearestTo(after);
    if (nearest.inside) next[node] = static_cast<std::uint32_t>(nearest.node);
  }
  built.next_.push_back(std::move(next));
  for (int level = 1; level <= levels; ++level) {
    const std::vector<std::uint32_t>& half = built.next_.back();
    std::vector<std::uint32_t> twice(nodes);
    for (std::size_t node = 0; node < nodes; ++node) {
      twice[node] = half[node] == kLeft ? kLeft : half[half[node]];
    }
    built.next_.push_back(std::move(twice));
  }
  return built;
}

Vec3 NearestLevels::After(const Vec3& point, std::uint32_t steps) const {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  const LevelGrid::Nearest start = grid_.NearestTo(point);
  if (!start.inside) return {kNowhere, kNowhere, kNowhere};
  auto node = static_cast<std::uint32_t>(start.node);
  for (int level = levels(); level >= 0; --level) {
    if ((steps >> level & 1U) == 0) continue;
    node = next_[static_cast<std::size_t>(level)][node];
    if (node == kLeft) return {kNowhere, kNowhere, kNowhere};
  }
  return grid_.Node(node);
}

}  // namespace pleinair::content
