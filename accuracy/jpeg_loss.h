#pragma once

#include <cstdint>

#include "base/image.h"

namespace pleinair::accuracy {

/// What a picture looks like after it was kept as a baseline JPEG of this quality, 1…100.
GreyImage AfterJpeg(const GreyImage& grey, int quality);

}  // namespace pleinair::accuracy
