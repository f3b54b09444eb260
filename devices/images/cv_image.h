#pragma once

// Internal: between the .cc files of this module; not installed.

#include <opencv2/core.hpp>

#include "devices/images/image_file.h"

namespace pleinair::devices {

/// Our two pictures of an 8-bit BGR one.
DecodedImage ImageFromBgr(const cv::Mat& bgr);

}  // namespace pleinair::devices
