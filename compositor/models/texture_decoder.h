#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::compositor {

/// Returns whether this build decodes WebP.
bool DecodesWebp();

/// Decodes a PNG, JPEG or WebP image to 3 or 4 channels (grey becomes 3), rows top-down. PNG of 16
/// bits is reduced to 8. The size in the header is checked before decoding: at most 16384 × 16384.
/// Errors: too large, cut short, another format. `where` names the image in errors.
Result<Image<std::uint8_t>> DecodeTexture(std::span<const std::byte> bytes,
                                          const std::string& where);

/// Reads and decodes a file in the same way.
Result<Image<std::uint8_t>> ReadTexture(const std::filesystem::path& file);

}  // namespace pleinair::compositor
