#pragma once

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::devices {

/// Decodes a JPEG, or a frame of Motion-JPEG (which may lack its Huffman tables; then those of
/// ITU-T T.81, Annex K.3, apply), into `rgb`, whose size must match. libjpeg repairs damaged data
/// and warns; here any warning is an error, because half a marker is worse than none. Errors: not a
/// JPEG, another size, truncated, damaged.
Result<void> DecodeJpeg(const std::vector<std::uint8_t>& bytes, RgbImage* rgb);

}  // namespace pleinair::devices
