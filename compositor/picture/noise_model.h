#pragma once

#include "compositor/picture/camera_look.h"
#include "compositor/picture/marker_in_image.h"

namespace pleinair::compositor {

/// Measures the noise of the marker's black band and of the white around it. Pixels near edges,
/// which are `blur_px` wide, are not used. Writes the noise members of `look`. Returns false, and
/// writes nothing, where neither has enough pixels.
bool MeasureNoise(const MarkerInImage& marker, double blur_px, CameraLook* look);

}  // namespace pleinair::compositor
