#pragma once
// Internal: between the .cc files of this module; not installed.

#include <cstdint>

#include "base/image.h"

namespace pleinair::tracker {

/// The image twice as large, interpolated linearly: pixel (2x, 2y) is pixel (x, y) of `grey`, so
/// that the size is 2w - 1 by 2h - 1. Keeps the memory of `doubled` where the size is the same.
void DoubleSize(ImageView<const std::uint8_t> grey, Image<std::uint8_t>* doubled);

}  // namespace pleinair::tracker
