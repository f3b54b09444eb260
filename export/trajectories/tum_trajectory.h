#pragma once

#include <string>
#include <string_view>

#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// Parses the trajectory format of the TUM RGB-D benchmark (Sturm et al. 2012): lines of `timestamp
/// tx ty tz qx qy qz qw`, in seconds. Each gives the position of the camera centre and the rotation
/// of the camera axes (x right, y down, z forward) in the reference. Commas and tabs also separate
/// fields, as in the benchmark's own tools.
/// Errors: no poses, malformed lines, numbers that are not finite, quaternions that are not
/// rotations, times that do not ascend.
Result<CameraTrajectory> ParseTum(std::string_view text, const std::string& name);

/// Formats a trajectory: nanometres and 9 decimals, quaternions with qw >= 0. `comment` is a
/// one-line comment at the start.
std::string TumText(const CameraTrajectory& path, std::string_view comment);

}  // namespace pleinair::exports
