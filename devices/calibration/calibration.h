#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/camera_model.h"
#include "base/error.h"

namespace pleinair::devices {

/// Reads a lens calibration. The format is detected from the content, not from the file's extension
/// (docs/guide/reference/recordings.md):
/// - pleinair's JSON: alone, as `calibration` of a recording.json, or as `intrinsics` of a
///   scene.json;
/// - OpenCV FileStorage, YAML or JSON (`camera_matrix`, `distortion_coefficients`);
/// - ROS camera_info YAML (plumb_bob, rational_polynomial, equidistant, fisheye);
/// - Kalibr camchain YAML (its `cam0`) and EuRoC sensor.yaml (camera_model pinhole).
/// Errors: another format; numbers missing or not finite; focal length not positive; size not in
/// 1…100000; a number of distortion coefficients that the model does not have; an unsupported
/// camera or distortion model (named in the message).
Result<CameraModel> ReadCalibration(const std::filesystem::path& file);

/// Parses a calibration from memory; `name` is the file's name in messages.
Result<CameraModel> ParseCalibration(std::string_view bytes, const std::string& name);

}  // namespace pleinair::devices
