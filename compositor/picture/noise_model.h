#pragma once

#include "compositor/picture/camera_look.h"
#include "compositor/picture/marker_in_image.h"

namespace pleinair::compositor {

/// Measures the noise of the marker's black band and of the white around it, out of the reach of
/// edges that are `blur_px` wide, and writes the noise's part of `look`. Returns false, and writes
/// nothing, where neither shows enough pixels.
bool MeasureNoise(const MarkerInImage& marker, double blur_px, CameraLook* look);

}  // namespace pleinair::compositor
