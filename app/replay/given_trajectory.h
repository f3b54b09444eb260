#pragma once

#include "base/error.h"
#include "export/trajectories/camera_trajectory.h"
#include "scene/trajectory_description.h"
#include "session/trajectory/given_trajectory.h"

namespace pleinair::app {

/// Reads the file of a trajectory, with the lens that it may hold. Errors: those of
/// ReadTrajectory(), an unknown format.
Result<exports::CameraTrajectory> ReadTrajectoryFile(
    const scene::TrajectoryDescription& description);

/// Reads a trajectory and the places that align it. Lengths are scaled and cameras are turned as
/// the description states. Errors: those of ReadTrajectoryFile() and ParsePlacePairs(), COLMAP
/// images without numbers.
Result<session::TrajectoryRequest> ReadGivenTrajectory(
    const scene::TrajectoryDescription& description);

}  // namespace pleinair::app
