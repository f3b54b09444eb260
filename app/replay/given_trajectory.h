#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/error.h"
#include "devices/frame.h"
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

/// The time of a recording's start by the camera's own clock, nanoseconds, from its first frame;
/// nothing if that has no stamp of the device. A trajectory may share this clock.
std::optional<std::int64_t> ClockStartOf(const devices::Frame& first);

/// An error of FitCamera() about a trajectory's lens, with where that lens is from.
Error OtherLensThanTrajectorys(Error error, const std::string& lens_from);

}  // namespace pleinair::app
