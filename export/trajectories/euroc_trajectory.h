#pragma once

#include <string>
#include <string_view>

#include "devices/recordings/euroc.h"
#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// Parses the ground-truth format of the EuRoC data sets (Burri et al. 2016): lines of `timestamp,
/// p_RS_R_x … z, q_RS_w x y z`, nanoseconds, metres. Further columns (velocity, biases) are
/// ignored. The file contains the body's trajectory. `body_from_camera` (T_BS of a camera's
/// sensor.yaml) converts it to the camera's; the default is identity. Errors: as ParseTum.
Result<CameraTrajectory> ParseEurocTrajectory(
    std::string_view text, const std::string& name,
    const Transform<devices::EurocBody, Camera>& body_from_camera = {});

/// Formats a trajectory as the eight columns of `vicon0/data.csv`.
std::string EurocTrajectoryText(const CameraTrajectory& path,
                                const Transform<devices::EurocBody, Camera>& body_from_camera = {});

}  // namespace pleinair::exports
