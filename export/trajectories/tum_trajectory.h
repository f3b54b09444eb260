#pragma once

#include <string>
#include <string_view>

#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// The trajectory form of the TUM RGB-D benchmark (Sturm et al. 2012): lines of
/// `timestamp tx ty tz qx qy qz qw`, seconds, the place of the camera's centre and the turn of its
/// axes (x right, y down, z forward) in the reference. Commas and tabs separate as well, as in the
/// benchmark's own tools.
/// Errors: no poses; lines of another form, numbers that are not finite, quaternions that are no
/// rotation, times that do not ascend.
Result<CameraTrajectory> ParseTum(std::string_view text, const std::string& name);

/// The same to write: nanometres and 9 decimals, quaternions with qw >= 0.
/// `comment` is put before it as a comment of one line.
std::string TumText(const CameraTrajectory& path, std::string_view comment);

}  // namespace pleinair::exports
