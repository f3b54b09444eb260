#pragma once

#include <vector>

#include "compositor/picture/marker_in_image.h"

namespace pleinair::compositor {

/// Estimates the blur of each side of the outer black square: standard deviation in pixels. Returns
/// one value per side that is visible well enough, at most four. Omits places where the light
/// changes or an occluder lies.
std::vector<double> EstimateEdgeBlur(const MarkerInImage& marker);

}  // namespace pleinair::compositor
