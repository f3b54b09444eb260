#include "content/flow/flow_levels.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/parallel_for.h"
#include "content/flow/field_probe.h"
#include "content/flow/first_step.h"
#include "content/flow/grid_stencil.h"
#include "content/flow/level_grid.h"

namespace pleinair::content {
namespace {

constexpr double kGone = std::numeric_limits<double>::quiet_NaN();
constexpr int kMaxLevels = 30;
constexpr std::size_t kBlock = 2048;  // Nodes that a thread takes at once.

bool IsGone(const Vec3& v) { return std::isnan(v.x); }

}  // namespace

struct FlowLevels::Parts {
  explicit Parts(const VectorField& field) : grid(field) {}

  LevelGrid grid;
  std::unique_ptr<FieldProbe> probe;
  Seconds frozen_s = 0.0, step_s = 0.0;
  std::uint64_t field_reads = 0;
  std::array<int, 3> axes{};  // Those that are not flat.
  /// By level: the displacements of all nodes along these axes. Not a number: the path left.
  std::vector<std::vector<float>> displacements;

  std::size_t dimensions() const { return static_cast<std::size_t>(grid.dimensions()); }
  void SetDisplacement(std::size_t level, std::size_t node, const Vec3& d);
  std::optional<Vec3> Displacement(std::size_t level, const Vec3& point) const;
  Vec3 Apply(std::size_t level, const Vec3& point, FieldProbe* own, std::uint64_t* reads) const;
};

void FlowLevels::Parts::SetDisplacement(std::size_t level, std::size_t node, const Vec3& d) {
  const std::array<double, 3> all{d.x, d.y, d.z};
  for (std::size_t a = 0; a < dimensions(); ++a) {
    displacements[level][node * dimensions() + a] =
        static_cast<float>(all[static_cast<std::size_t>(axes[a])]);
  }
}

/// Interpolated; unset where the point is outside, or a node of the stencil has left.
std::optional<Vec3> FlowLevels::Parts::Displacement(std::size_t level, const Vec3& point) const {
  const LevelGrid::Place place = grid.Find(point);
  if (!place.inside) return std::nullopt;
  std::array<AxisStencil, 3> s;
  for (std::size_t a = 0; a < 3; ++a) {
    s[a] = HermiteStencil(grid.axes()[a], place.index[a], place.fraction[a]);
  }
  const float* const values = displacements[level].data();
  const std::size_t count = dimensions();
  std::array<double, 3> sum{};
  for (std::size_t k = 0; k < 4; ++k) {
    if (s[2].weight[k] == 0.0) continue;
    for (std::size_t j = 0; j < 4; ++j) {
      const double plane = s[2].weight[k] * s[1].weight[j];
      if (plane == 0.0) continue;
      for (std::size_t i = 0; i < 4; ++i) {
        const double weight = plane * s[0].weight[i];
        if (weight == 0.0) continue;
        const float* const node =
            values + count * grid.Number(s[0].node[i], s[1].node[j], s[2].node[k]);
        for (std::size_t c = 0; c < count; ++c) sum[c] += weight * static_cast<double>(node[c]);
      }
    }
  }
  if (std::isnan(sum[0])) return std::nullopt;
  std::array<double, 3> all{};
  for (std::size_t c = 0; c < count; ++c) all[static_cast<std::size_t>(axes[c])] = sum[c];
  return Vec3{all[0], all[1], all[2]};
}

/// A point after 2^level steps.
Vec3 FlowLevels::Parts::Apply(std::size_t level, const Vec3& point, FieldProbe* own,
                              std::uint64_t* reads) const {
  if (const auto moved = Displacement(level, point)) return point + *moved;
  // Near the border: by the halves, and at last by the field itself.
  if (level == 0) return FirstStep(own, point, frozen_s, step_s, reads);
  const Vec3 half = Apply(level - 1, point, own, reads);
  return IsGone(half) ? half : Apply(level - 1, half, own, reads);
}

FlowLevels::FlowLevels(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
FlowLevels::~FlowLevels() = default;
FlowLevels::FlowLevels(FlowLevels&&) noexcept = default;
FlowLevels& FlowLevels::operator=(FlowLevels&&) noexcept = default;

int FlowLevels::levels() const { return static_cast<int>(parts_->displacements.size()) - 1; }
std::uint64_t FlowLevels::field_reads() const { return parts_->field_reads; }

Result<FlowLevels> FlowLevels::Build(const VectorField& field, Seconds frozen_s, Seconds step_s,
                                     int levels, int threads) {
  auto parts = std::make_unique<Parts>(field);
  std::size_t used = 0;
  for (int a = 0; a < 3; ++a) {
    if (!parts->grid.axes()[static_cast<std::size_t>(a)].flat()) parts->axes[used++] = a;
  }
  const std::size_t nodes = parts->grid.nodes();
  const std::size_t values = nodes * parts->dimensions();
  if (levels < 0 || levels > kMaxLevels ||
      values > kMaxValues / (static_cast<std::size_t>(levels) + 1)) {
    return InputError(
        "",
        "needs " + std::to_string(levels + 1) + " levels of " + std::to_string(nodes) + " points",
        "use fewer steps, or integrate with --method rk45");
  }
  PLEINAIR_ASSIGN_OR_RETURN(parts->probe, MakeFrozenProbe(field, frozen_s));
  parts->frozen_s = frozen_s;
  parts->step_s = step_s;
  std::atomic<std::uint64_t> reads = 0;
  for (std::size_t level = 0; level <= static_cast<std::size_t>(levels); ++level) {
    parts->displacements.emplace_back(values);
    ParallelFor((nodes + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
      const std::unique_ptr<FieldProbe> own = parts->probe->Copy();
      std::uint64_t own_reads = 0;
      const std::size_t end = std::min(nodes, (block + 1) * kBlock);
      for (std::size_t node = block * kBlock; node < end; ++node) {
        const Vec3 start = parts->grid.Node(node);
        Vec3 after;
        if (level == 0) {
          after = FirstStep(own.get(), start, frozen_s, step_s, &own_reads);
        } else {
          // At a node, the displacement needs no interpolation.
          std::array<double, 3> half{};
          for (std::size_t c = 0; c < parts->dimensions(); ++c) {
            half[static_cast<std::size_t>(parts->axes[c])] = static_cast<double>(
                parts->displacements[level - 1][node * parts->dimensions() + c]);
          }
          after = start + Vec3{half[0], half[1], half[2]};
          if (!std::isnan(after.x + after.y + after.z)) {
            after = parts->Apply(level - 1, after, own.get(), &own_reads);
          } else {
            after = {kGone, kGone, kGone};
          }
        }
        parts->SetDisplacement(level, node, after - start);
      }
      reads += own_reads;
    });
  }
  parts->field_reads = reads;
  return FlowLevels(std::move(parts));
}

Vec3 FlowLevels::After(const Vec3& point, std::uint32_t steps) const {
  Vec3 at = point;
  std::unique_ptr<FieldProbe> own;
  std::uint64_t ignored = 0;
  for (int level = levels(); level >= 0 && !IsGone(at); --level) {
    if ((steps >> level & 1U) == 0) continue;
    if (const auto moved = parts_->Displacement(static_cast<std::size_t>(level), at)) {
      at = at + *moved;
      continue;
    }
    if (!own) own = parts_->probe->Copy();
    at = parts_->Apply(static_cast<std::size_t>(level), at, own.get(), &ignored);
  }
  return at;
}

}  // namespace pleinair::content
