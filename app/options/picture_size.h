#pragma once

#include <string>

#include "base/camera_model.h"
#include "base/error.h"

namespace pleinair::app {

struct ImageSize {
  int width = 0;
  int height = 0;
};

/// "1280x720", which was given for `option`; errors: not two whole numbers of 16…16384.
Result<ImageSize> ParsePictureSize(const std::string& option, const std::string& text);

/// The lens as it looks after resizing its pictures to `size`.
CameraModel ScaleCamera(const CameraModel& camera, ImageSize size);

}  // namespace pleinair::app
