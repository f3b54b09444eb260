#pragma once

#include <vector>

#include "base/vector.h"
#include "compositor/lens/thin_lens.h"

namespace pleinair::compositor {

/// Places spread evenly over the area of a stop whose circumscribed circle has the radius 1: x to
/// the image's right, y down. Their mean is the centre. `count` from 1 on; one place is the centre.
/// The places follow a golden-angle spiral (Vogel 1979, "A better way to construct the sunflower
/// head"), in a polygon its image along the edges.
std::vector<Vec2> StopPlaces(const LensStop& stop, int count);

}  // namespace pleinair::compositor
