#pragma once

#include <vector>

#include "export/trajectories/camera_trajectory.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// The camera's pose at an observation, in the marker's frame.
exports::TrajectoryPose ObservedPose(const session::Observation& at);

/// The camera's trajectory in the frame of the observed marker. Image names are those of replay's
/// frames: frames/0000.png and so on.
exports::CameraTrajectory ObservedTrajectory(const std::vector<session::Observation>& observations);

/// Comment of files with such poses.
inline constexpr const char* kObservedTrajectoryComment =
    "camera in the marker frame: t_s tx ty tz qx qy qz qw (x_marker = R(q) x_camera + t)";

}  // namespace pleinair::app
