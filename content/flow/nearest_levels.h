#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "content/flow/level_grid.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// Aristizabal et al. 2012, as published: each node's step ends at the node nearest to y' (Eq. 9),
/// and I_k(i) = I_{k−1}(I_{k−1}(i)) (Eq. 20). y' is integrated, which they propose in place of
/// Euler's step of Eq. 8. For comparison alone: rounding is the same at every visit of a node, so
/// errors are those of whole cells. Steps of less than half a cell stand still.
class NearestLevels {
 public:
  /// As FlowLevels::Build().
  static Result<NearestLevels> Build(const VectorField& field, Seconds frozen_s, Seconds step_s,
                                     int levels);

  int levels() const { return static_cast<int>(next_.size()) - 1; }
  std::uint64_t field_reads() const { return field_reads_; }

  /// The node of a particle that starts at the node nearest to `point`. Not a number: it has left.
  /// The order of the levels is free (Algorithm 1), as powers of one map commute.
  Vec3 After(const Vec3& point, std::uint32_t steps) const;

  static constexpr std::size_t kMaxNodes = std::size_t{1} << 31;

 private:
  explicit NearestLevels(const VectorField& field) : grid_(field) {}

  LevelGrid grid_;
  std::uint64_t field_reads_ = 0;
  std::vector<std::vector<std::uint32_t>> next_;  // By level, of each node; kLeft: it left.
};

}  // namespace pleinair::content
