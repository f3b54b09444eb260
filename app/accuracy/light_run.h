#pragma once

#include <string>
#include <vector>

#include "accuracy/image_record.h"
#include "base/error.h"

namespace pleinair::app {

/// A composed picture's record with what the page shows of it: JPEG in base 64.
struct LightPicture {
  accuracy::ImageRecord record;
  std::string truth, composed, difference;
};

/// Composes a recording, as `pleinair replay --frames` does, and compares its key frames with the
/// true pictures, as `pleinair compare` does; nothing for recordings without true pictures. One at
/// a time: a replay uses all cores. Errors: as of these commands; interruption.
Result<std::vector<LightPicture>> MeasureLight(const std::string& recording);

}  // namespace pleinair::app
