#pragma once

#include <string>

#include "base/error.h"
#include "base/image_size.h"

namespace pleinair::app {

/// Parses "1280x720", the value of `option`. Errors: not two whole numbers of 16…16384.
Result<ImageSize> ParsePictureSize(const std::string& option, const std::string& text);

}  // namespace pleinair::app
