#pragma once

#include <optional>

#include "base/camera_model.h"
#include "base/error.h"
#include "devices/frame.h"

namespace pleinair::devices {

/// Where frames come from. One thread calls Next() at a time.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame, nothing at the end, or an error that names the file or device.
  virtual Result<std::optional<Frame>> Next() = 0;

  /// How many frames there will be, where that is known (recordings).
  virtual std::optional<std::int64_t> FrameCount() const = 0;
};

}  // namespace pleinair::devices
