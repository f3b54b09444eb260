#pragma once

#include <cstdint>

#include "base/image.h"

namespace pleinair::devices {

/// An 8-bit RGB image at another size, pixels: area average where it shrinks, bicubic where it
/// grows.
RgbImage ResizeRgb(ImageView<const std::uint8_t> rgb, int width, int height);

}  // namespace pleinair::devices
