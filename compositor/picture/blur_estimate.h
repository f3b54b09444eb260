#pragma once

#include <array>
#include <vector>

#include "compositor/picture/marker_in_image.h"

namespace pleinair::compositor {

/// Estimates the blur of each side of the outer black square: standard deviation in pixels. Returns
/// one value per side that is visible well enough, at most four. Omits places where the light
/// changes or an occluder lies. `circles_px`: diameter of each side's circle of confusion, which
/// the estimates then exclude. Sides: top, left, bottom, right.
std::vector<double> EstimateEdgeBlur(const MarkerInImage& marker,
                                     const std::array<double, 4>& circles_px = {});

}  // namespace pleinair::compositor
