#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/error.h"

namespace pleinair::files {

/// Size limit of a scene description: room for one pose per frame over several hours.
constexpr std::size_t kMaxDescriptionBytes = std::size_t{16} << 20;
/// Size limit of a calibration: a page of numbers, or a scene.json with its poses.
constexpr std::size_t kMaxCalibrationBytes = std::size_t{4} << 20;

/// Checks that a name is that of a regular file, or of a link to one. Error (input): it is not; the
/// message states what it is instead.
Result<void> CheckRegularFile(const std::filesystem::path& file);

/// Reads all bytes of a regular file of at most `max_bytes`. Errors: no regular file, not
/// readable, empty, too large.
Result<std::string> ReadWholeFile(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace pleinair::files
