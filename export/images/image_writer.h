#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::exports {

/// Writes an 8-bit RGB picture as PNG with an sRGB chunk and nothing that varies between runs.
/// Errors as WriteError, without leaving a file.
Result<void> WritePng(const std::filesystem::path& file, ImageView<const std::uint8_t> rgb);

/// A picture as JPEG bytes, quality 0…100, at most `max_width` wide: for the report.
std::vector<std::uint8_t> EncodeJpeg(ImageView<const std::uint8_t> rgb, int max_width, int quality);

}  // namespace pleinair::exports
