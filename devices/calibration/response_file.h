#pragma once

#include <filesystem>

#include "base/camera_response.h"
#include "base/error.h"

namespace pleinair::devices {

/// Reads a camera's response from a file of JSON (docs/guide/reference/recordings.md):
/// `{"response": "srgb"}`,
/// `{"response": "gamma", "gamma": 2.2}`, or `{"response": "samples", "encoded": [0, …, 1],
/// "light": [0, …, 1]}`, where `red`, `green` and `blue` may stand in place of `light`.
/// Errors (input): no such file, not that form, samples that do not rise from 0 to 1.
Result<CameraResponse> ReadCameraResponse(const std::filesystem::path& file);

}  // namespace pleinair::devices
