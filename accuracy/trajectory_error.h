#pragma once

#include <cstdint>
#include <optional>

#include "base/trajectory.h"

namespace pleinair::accuracy {

/// Errors of a trajectory against the ground truth, as in the TUM RGB-D benchmark: Sturm,
/// Engelhard, Endres, Burgard & Cremers 2012, "A benchmark for the evaluation of RGB-D SLAM
/// systems", section IV.
struct TrajectoryError {
  std::int64_t poses = 0;               ///< Times that both trajectories have,
  std::int64_t steps = 0;               ///< … and pairs of consecutive ones.
  double ate_rmse_m = 0.0;              ///< Absolute, after the best rigid alignment.
  double ate_unaligned_rmse_m = 0.0;    ///< The same without alignment, in the marker frame.
  double rpe_translation_rmse_m = 0.0;  ///< Relative, from one frame to the next,
  double rpe_rotation_rmse_deg = 0.0;   ///< … and its rotation.
};

/// Poses are matched by equal time stamps. Steps are those between consecutive frames of the ground
/// truth, so that gaps do not count. Nullopt without a common pose.
std::optional<TrajectoryError> CompareTrajectories(const Trajectory& found,
                                                   const Trajectory& truth);

}  // namespace pleinair::accuracy
