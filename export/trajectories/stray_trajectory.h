#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/camera_model.h"
#include "export/trajectories/camera_trajectory.h"

namespace pleinair::exports {

/// Parses the odometry.csv of Stray Scanner, an app for ARKit. Source: docs/format.md and
/// StrayScanner/Helpers/OdometryEncoder.swift of github.com/strayrobots/scanner. The header names
/// `timestamp, frame, x, y, z, qx, qy, qz, qw`; further columns (a lens) are ignored. Seconds by
/// the phone's own clock, metres. Poses are world-from-camera, quaternions x y z w. The world is
/// ARKit's: y up. The camera has x right, y down, z forward in the landscape images of rgb.mp4. The
/// app turns ARKit's camera (y up, z backward) by half a turn about x before it writes.
/// Errors: no header (files of the first versions have no times), malformed lines, numbers that are
/// not finite, quaternions that are not rotations. Also times or numbers of frames that do not
/// ascend, no poses.
Result<CameraTrajectory> ParseStrayOdometry(std::string_view text, const std::string& name);

/// Parses its camera_matrix.csv, three lines of three numbers: fx 0 cx, 0 fy cy, 0 0 1, for
/// rgb.mp4. The file has no size. Nothing unless the centre is within a tenth of that of 1920×1440
/// images, which the app records (stray_visualize.py of github.com/kekeblom/StrayVisualizer). The
/// pixel origin of ARKit's intrinsics is the corner of the image. Errors: malformed lines.
Result<std::optional<CameraModel>> ParseStrayCamera(std::string_view text, const std::string& name);

/// True for a text whose first line is the header of an odometry.csv.
bool IsStrayOdometry(std::string_view text);

}  // namespace pleinair::exports
