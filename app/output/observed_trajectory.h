#pragma once

#include <vector>

#include "export/trajectories/camera_trajectory.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// Where the camera was when it saw the marker, in the marker's frame.
exports::TrajectoryPose ObservedPose(const session::Observation& at);

/// The camera's path in the frame of the marker that it was observed from. Pictures are named as
/// replay writes frames, frames/0000.png and so on.
exports::CameraTrajectory ObservedTrajectory(const std::vector<session::Observation>& observations);

/// How a file of such poses says what they are.
inline constexpr const char* kObservedTrajectoryComment =
    "camera in the marker frame: t_s tx ty tz qx qy qz qw (x_marker = R(q) x_camera + t)";

}  // namespace pleinair::app
