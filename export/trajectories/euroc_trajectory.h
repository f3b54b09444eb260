#pragma once

#include <string>
#include <string_view>

#include "devices/recordings/euroc.h"
#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// The ground truth form of the EuRoC data sets (Burri et al. 2016): lines of
/// `timestamp, p_RS_R_x … z, q_RS_w x y z`, nanoseconds, metres; further columns (velocity,
/// biases) are not used. They tell the body's path; `body_from_camera` (T_BS of a camera's
/// sensor.yaml; none: the camera is the body) makes it the camera's.
/// Errors: as ParseTum.
Result<CameraTrajectory> ParseEurocTrajectory(
    std::string_view text, const std::string& name,
    const Transform<devices::EurocBody, Camera>& body_from_camera = {});

/// The same to write, the eight columns of `vicon0/data.csv`.
std::string EurocTrajectoryText(const CameraTrajectory& path,
                                const Transform<devices::EurocBody, Camera>& body_from_camera = {});

}  // namespace pleinair::exports
