#pragma once

#include <cstdint>

#include "base/camera_image.h"
#include "base/image.h"

namespace pleinair::devices {

/// Resizes an 8-bit RGB image to width × height pixels: area average when shrinking, bicubic when
/// enlarging.
RgbImage ResizeRgb(ImageView<const std::uint8_t> rgb, int width, int height);
/// The same of 16 bits.
DeepImage ResizeDeep(ImageView<const std::uint16_t> deep, int width, int height);

}  // namespace pleinair::devices
