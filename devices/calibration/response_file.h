#pragma once

#include <filesystem>
#include <string>

#include "base/camera_response.h"
#include "base/error.h"

namespace pleinair::devices {

/// Reads a camera response from a JSON file (docs/guide/reference/recordings.md): `{"response":
/// "srgb"}`, `{"response": "gamma", "gamma": 2.2}`, or `{"response": "samples", "encoded": [0, …,
/// 1], "light": [0, …, 1]}`, with `red`, `green` and `blue` as an alternative to `light`. Errors
/// (input): no such file, another format, samples that do not rise from 0 to 1.
Result<CameraResponse> ReadCameraResponse(const std::filesystem::path& file);

/// Contents of a file that ReadCameraResponse() reads: 52 samples a channel, between which the
/// curve is off by less than the step of a pixel value; or "srgb".
std::string CameraResponseText(const CameraResponse& response);

}  // namespace pleinair::devices
