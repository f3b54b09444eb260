#pragma once

#include <cstdint>

#include "base/image.h"

namespace pleinair::devices {

/// Resizes an 8-bit RGB image to width × height pixels: area average when shrinking, bicubic when
/// enlarging.
RgbImage ResizeRgb(ImageView<const std::uint8_t> rgb, int width, int height);

}  // namespace pleinair::devices
