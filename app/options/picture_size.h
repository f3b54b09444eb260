#pragma once

#include <string>

#include "base/error.h"
#include "base/image_size.h"

namespace pleinair::app {

/// "1280x720", which was given for `option`; errors: not two whole numbers of 16…16384.
Result<ImageSize> ParsePictureSize(const std::string& option, const std::string& text);

}  // namespace pleinair::app
