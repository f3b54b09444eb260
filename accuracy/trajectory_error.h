#pragma once

#include <cstdint>
#include <optional>

#include "base/trajectory.h"

namespace pleinair::accuracy {

/// Errors of a path against the truth, in the terms of the TUM RGB-D benchmark: Sturm, Engelhard,
/// Endres, Burgard & Cremers 2012, "A benchmark for the evaluation of RGB-D SLAM systems",
/// section IV.
struct TrajectoryError {
  std::int64_t poses = 0;               ///< Moments that both have,
  std::int64_t steps = 0;               ///< … and pairs of neighbouring ones.
  double ate_rmse_m = 0.0;              ///< Absolute, after the best rigid alignment.
  double ate_unaligned_rmse_m = 0.0;    ///< The same in the marker's own frame.
  double rpe_translation_rmse_m = 0.0;  ///< Relative, from one frame to the next,
  double rpe_rotation_rmse_deg = 0.0;   ///< … and its rotation.
};

/// Poses are matched by equal stamps. Steps are those between neighbouring frames of the truth, so
/// that gaps count neither for nor against. Nothing without a pose in common.
std::optional<TrajectoryError> CompareTrajectories(const Trajectory& found,
                                                   const Trajectory& truth);

}  // namespace pleinair::accuracy
