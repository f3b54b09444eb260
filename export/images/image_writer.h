#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::exports {

/// Writes an 8-bit RGB image as PNG with an sRGB chunk and no data that varies between runs.
/// Errors: as WriteError; no file remains.
Result<void> WritePng(const std::filesystem::path& file, ImageView<const std::uint8_t> rgb);

/// Encodes an image as JPEG for the report: quality 0…100, at most `max_width` pixels wide.
std::vector<std::uint8_t> EncodeJpeg(ImageView<const std::uint8_t> rgb, int max_width, int quality);

}  // namespace pleinair::exports
