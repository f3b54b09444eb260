#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <opencv2/core.hpp>

#include "devices/images/image_file.h"

namespace pleinair::devices {

/// Converts an 8-bit BGR image to our RGB and grey images.
DecodedImage ImageFromBgr(const cv::Mat& bgr);

}  // namespace pleinair::devices
