#pragma once
// Internal: shared by the .cc files of this module; not installed.

#include <cstdint>

#include "base/image.h"

namespace pleinair::tracker {

/// Doubles the size of an image by linear interpolation: pixel (2x, 2y) is pixel (x, y) of `grey`,
/// so the size is 2w - 1 by 2h - 1. Reuses the memory of `doubled` if the size is the same.
void DoubleSize(ImageView<const std::uint8_t> grey, Image<std::uint8_t>* doubled);

}  // namespace pleinair::tracker
