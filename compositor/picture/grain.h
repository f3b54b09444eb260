#pragma once

#include "base/image.h"

namespace pleinair::compositor {

/// Makes four channels of normally distributed numbers with mean 0 and variance 1. Adjacent pixels
/// have the given correlation (0…0.7), different channels have none. The image tiles without a
/// seam. Equal arguments give equal images.
Image<float> MakeGrain(int side, double neighbour_correlation);

}  // namespace pleinair::compositor
