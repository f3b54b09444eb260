#pragma once

#include <vector>

#include "compositor/picture/marker_in_image.h"

namespace pleinair::compositor {

/// Standard deviation, pixels, of the spread of each side of the outer black square: of those that
/// show well enough, at most four. Apart from where light or an occluder changes.
std::vector<double> EstimateEdgeBlur(const MarkerInImage& marker);

}  // namespace pleinair::compositor
