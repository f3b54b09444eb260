#pragma once

#include <filesystem>
#include <string_view>

#include "base/camera_model.h"
#include "base/error.h"

namespace pleinair::devices {

/// Reads a calibration by its content, whatever its ending: our JSON, OpenCV YAML/XML-less
/// FileStorage, ROS camera_info YAML, Kalibr camchain YAML (cam0).
/// Errors: not one of these, numbers missing or not finite, focal length not positive, size not
/// positive, a distortion model we do not know (named).
Result<CameraModel> ReadCalibration(const std::filesystem::path& file);

/// The same on bytes in memory; `name` stands in messages.
Result<CameraModel> ParseCalibration(std::string_view bytes, const std::string& name);

}  // namespace pleinair::devices
