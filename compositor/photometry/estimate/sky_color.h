#pragma once

#include <vector>

#include "compositor/photometry/estimate/light_cell.h"

namespace pleinair::compositor {

/// A contrast between sun and shade, and its weight: the probability that it is one.
struct WeightedContrast {
  const LightCell* cell = nullptr;
  double weight = 0.0;
};

/// Fits the color of the sky beside the sun. Returns what to add to the logarithm of its scale in
/// each channel; the luminance of this is 0. The colors of the contrasts are compared with those
/// predicted at `log_sky_scale` (one Gauss–Newton step). The result is shrunk towards the model's
/// color by both errors.
LogRgb FitSkyColor(const std::vector<WeightedContrast>& contrasts, double log_sky_scale);

}  // namespace pleinair::compositor
