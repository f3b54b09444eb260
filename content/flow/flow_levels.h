#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// Where the particles of all nodes of a grid are after 1, 2, 4, …, 2^levels steps: hierarchical
/// integration (Hlawatsch, Sadlo, Weiskopf 2011). Level k + 1 applies level k twice,
/// D(y) ← D(y) + D(y + D(y)), with Catmull-Rom interpolation between nodes. The first step is
/// integrated by eight steps of Runge and Kutta's method. Where a node of the stencil has left the
/// field, the particle is integrated directly.
///
/// Deviation: Aristizabal et al. 2012 keep the nearest node in place of the displacement. Their
/// rounding is the same at every visit; see NearestLevels and tests/content/flow.
class FlowLevels {
 public:
  /// Levels of the steady state at `frozen_s` with steps of `step_s`, negative: upstream. Memory:
  /// 4 bytes a node, level and dimension. Errors (input): those of reading; more than 30 levels or
  /// kMaxValues.
  static Result<FlowLevels> Build(const VectorField& field, Seconds frozen_s, Seconds step_s,
                                  int levels, int threads = 0);
  ~FlowLevels();
  FlowLevels(FlowLevels&&) noexcept;
  FlowLevels& operator=(FlowLevels&&) noexcept;

  int levels() const;
  /// Velocities that Build() read.
  std::uint64_t field_reads() const;

  /// Where a particle is after a number of steps, which may have any bits below 2^(levels + 1).
  /// Not a number: it has left.
  Vec3 After(const Vec3& point, std::uint32_t steps) const;

  static constexpr std::size_t kMaxValues = std::size_t{1} << 31;

 private:
  struct Parts;
  explicit FlowLevels(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace pleinair::content
