#pragma once

#include <cstdint>

#include "base/image.h"

namespace pleinair::accuracy {

/// The image after encoding as a baseline JPEG of this quality, 1…100, and decoding.
GreyImage AfterJpeg(const GreyImage& grey, int quality);

}  // namespace pleinair::accuracy
