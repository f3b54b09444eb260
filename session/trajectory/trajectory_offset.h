#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/camera_model.h"
#include "session/marker_tracks.h"
#include "session/trajectory/given_trajectory.h"
#include "session/trajectory/trajectory_alignment.h"

namespace pleinair::session {

/// Offset of two clocks: time of the recording minus time of a trajectory.
struct TrajectoryOffset {
  std::int64_t offset_ns = 0;
  /// Standard deviation of an estimated offset, seconds; nothing: given or assumed.
  std::optional<double> deviation_s;
  bool is_given = false;  ///< Stated by the user.
};

/// The frames that show the marker and have a pose in the trajectory.
std::vector<TrajectoryView> TrajectoryViews(const GivenTrajectory& trajectory,
                                            const std::vector<Observation>& track,
                                            std::int64_t offset_ns);

/// The offset, nanoseconds, where none is estimated: 0 if any frame then has a pose. Otherwise that
/// of the camera's own clock, if any frame then has one. Else the clocks differ, and the trajectory
/// begins with the recording. `clock_start_ns`: time of the recording's start by the camera's
/// clock, if known.
std::int64_t AssumedOffset(const GivenTrajectory& trajectory, const std::vector<FrameTime>& frames,
                           std::optional<std::int64_t> clock_start_ns);

/// Estimates the offset, within 2 s of `assumed_ns`, with which the trajectory fits the marker's
/// corners best. The cost is the mean of log(1 + d²) over at most 24 views, with the distance d in
/// standard deviations. The deviation is sqrt(2 c / χ²''): there χ² exceeds its minimum by c, which
/// is χ² over its degrees of freedom, at least 1. Returns the assumed offset if the frames do not
/// determine one: fewer than 8 frames or a span below 0.5 s. Also for a deviation above 20 ms, and
/// for a minimum at the end of the range.
TrajectoryOffset EstimateOffset(const CameraModel& camera, double marker_size_m,
                                const GivenTrajectory& trajectory,
                                const std::vector<Observation>& track, std::int64_t assumed_ns);

}  // namespace pleinair::session
