#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/camera_model.h"
#include "base/error.h"

namespace pleinair::devices {

/// Reads a lens calibration by its content, whatever the file's ending
/// (docs/guide/reference/recordings.md):
/// - our JSON, alone, as `calibration` of a recording.json or as `intrinsics` of a scene.json;
/// - OpenCV FileStorage, YAML or JSON (`camera_matrix`, `distortion_coefficients`);
/// - ROS camera_info YAML (plumb_bob, rational_polynomial, equidistant, fisheye);
/// - Kalibr camchain YAML (its `cam0`) and EuRoC sensor.yaml (camera_model pinhole).
/// Errors: not one of these, numbers missing or not finite, focal length not positive, size not
/// in 1…100000, a number of distortion coefficients that the model does not have, a camera or
/// distortion model that we do not know (named).
Result<CameraModel> ReadCalibration(const std::filesystem::path& file);

/// The same on bytes in memory; `name` stands for the file in messages.
Result<CameraModel> ParseCalibration(std::string_view bytes, const std::string& name);

}  // namespace pleinair::devices
