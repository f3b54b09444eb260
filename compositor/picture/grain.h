#pragma once

#include "base/image.h"

namespace pleinair::compositor {

/// Four channels of normally distributed numbers of mean 0 and variance 1, of which those of pixels
/// side by side have this correlation (0…0.7) and those of different channels none. Tiles without
/// a seam. Equal arguments give equal tiles.
Image<float> MakeGrain(int side, double neighbour_correlation);

}  // namespace pleinair::compositor
