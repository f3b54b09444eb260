#pragma once

#include "base/image.h"

namespace pleinair::compositor {

/// Fills an image from its valid pixels: each pixel receives the weighted mean of the nearest ones,
/// by a pyramid of means (push–pull: Gortler et al. 1996, "The Lumigraph", section 3.4). `values`:
/// any channels. `weights`: one channel, 0…1, the same size; pixels of weight 1 keep their values.
/// Without any weight all pixels become 0.
Image<float> FillFromNearest(const Image<float>& values, const Image<float>& weights);

}  // namespace pleinair::compositor
