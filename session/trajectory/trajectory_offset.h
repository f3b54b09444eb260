#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/camera_model.h"
#include "session/marker_tracks.h"
#include "session/trajectory/given_trajectory.h"
#include "session/trajectory/trajectory_alignment.h"

namespace pleinair::session {

/// Time of the recording minus time of a trajectory.
struct TrajectoryOffset {
  std::int64_t offset_ns = 0;
  /// Standard deviation of an estimated offset, seconds; nothing: given or assumed.
  std::optional<double> deviation_s;
};

/// The frames that show the marker and have a pose in the trajectory.
std::vector<TrajectoryView> TrajectoryViews(const GivenTrajectory& trajectory,
                                            const std::vector<Observation>& track,
                                            std::int64_t offset_ns);

/// The offset without any estimate: 0 if any frame then has a pose. Otherwise that of the camera's
/// own clock, if any frame then has one. Else the clocks differ, and the trajectory begins with the
/// recording. `clock_start_ns`: time of the recording's start by the camera's clock, if known.
std::int64_t AssumedOffset(const GivenTrajectory& trajectory, const std::vector<FrameTime>& frames,
                           std::optional<std::int64_t> clock_start_ns);

/// Estimates the offset: of those within 2 s of `assumed_ns`, it is that with which the
/// trajectory fits the marker's corners best. The deviation is that of the parabola through the
/// minimum of chi-square, in units of chi-square over its degrees of freedom. Returns the assumed
/// offset if the marker's frames do not determine one. These are fewer than 8 frames or less than
/// 0.5 s, a deviation above 20 ms, and a minimum at the end of the range.
TrajectoryOffset EstimateOffset(const CameraModel& camera, double marker_size_m,
                                const GivenTrajectory& trajectory,
                                const std::vector<Observation>& track, std::int64_t assumed_ns);

}  // namespace pleinair::session
