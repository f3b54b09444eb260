#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::compositor {

/// Decodes a PNG or JPEG picture to 3 or 4 channels (grey becomes 3), 8 bits, rows top-down. The
/// size in its header is checked before anything is decoded: at most 16384 × 16384.
/// `where` names the picture in errors: too large, cut short, another format.
Result<Image<std::uint8_t>> DecodeTexture(std::span<const std::byte> bytes,
                                          const std::string& where);

/// The same from a file.
Result<Image<std::uint8_t>> ReadTexture(const std::filesystem::path& file);

}  // namespace pleinair::compositor
