#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/error.h"

namespace pleinair::files {

/// The largest file of words and numbers we read: a scene with a pose a frame for hours.
constexpr std::size_t kMaxDescriptionBytes = std::size_t{16} << 20;
/// The largest calibration: a page of numbers, or a scene.json with its poses.
constexpr std::size_t kMaxCalibrationBytes = std::size_t{4} << 20;

/// All bytes of a regular file of at most `max_bytes`.
/// Errors: not there, a folder, not readable, empty, larger than that.
Result<std::string> ReadWholeFile(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace pleinair::files
