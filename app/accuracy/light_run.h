#pragma once

#include <string>
#include <vector>

#include "accuracy/image_record.h"
#include "base/error.h"

namespace pleinair::app {

/// A composited image's record and its images for the page: JPEG in base 64.
struct LightPicture {
  accuracy::ImageRecord record;
  std::string truth, composed, difference;
};

/// Composites a recording, as `pleinair replay --frames` does. Compares its key frames with the
/// ground-truth images, as `pleinair compare` does. Returns nothing for recordings without
/// ground-truth images. Runs one recording at a time, because a replay uses all cores. Errors: as
/// these commands; interruption.
Result<std::vector<LightPicture>> MeasureLight(const std::string& recording);

}  // namespace pleinair::app
