#pragma once

#include <vector>

#include "compositor/photometry/estimate/light_cell.h"

namespace pleinair::compositor {

/// A contrast between sun and shade, and its weight: the probability that it is one.
struct WeightedContrast {
  const LightCell* cell = nullptr;
  double weight = 0.0;
};

/// Color of the sky beside the sun: what is to be added to the logarithm of its scale in each
/// channel, of which the luminance is 0. By the colors of the contrasts beside those predicted at
/// `log_sky_scale` (one Gauss–Newton step), shrunk towards the model's color by both errors.
LogRgb FitSkyColor(const std::vector<WeightedContrast>& contrasts, double log_sky_scale);

}  // namespace pleinair::compositor
