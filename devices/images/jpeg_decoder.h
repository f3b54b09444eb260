#pragma once

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::devices {

/// Decodes a JPEG or a frame of Motion-JPEG (which may lack its Huffman tables: ITU-T T.81, Annex
/// K.3 then holds) into `rgb`, which has the size that it must have. A decoder mends what it can
/// and warns; here an image with a warning is a damaged one: half a marker is worse than none.
/// Errors: no JPEG, another size, cut short, damaged.
Result<void> DecodeJpeg(const std::vector<std::uint8_t>& bytes, RgbImage* rgb);

}  // namespace pleinair::devices
