#pragma once

#include "compositor/picture/camera_look.h"
#include "compositor/picture/marker_in_image.h"

namespace pleinair::compositor {

/// Measures the noise of the print's black band and of the white around it, out of the reach of
/// edges that are `blur_px` wide, and writes the noise's part of `look`. Returns false, and writes
/// nothing, where neither shows enough pixels.
bool MeasureNoise(const PrintInPicture& print, double blur_px, PictureLook* look);

}  // namespace pleinair::compositor
