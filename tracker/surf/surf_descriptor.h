#pragma once

#include <array>

namespace pleinair::tracker {

/// 64 values of unit length (all 0 where the image is uniform): for each of the 4 x 4 subregions,
/// row by row in the keypoint's axes, (sum dx, sum dy, sum |dx|, sum |dy|) (Bay et al. 2008,
/// section 4.2, Eq. (5)).
using SurfDescriptor = std::array<float, 64>;

}  // namespace pleinair::tracker
