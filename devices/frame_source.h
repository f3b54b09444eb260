#pragma once

#include <cstdint>
#include <optional>

#include "base/error.h"
#include "devices/frame.h"

namespace pleinair::devices {

/// Where frames come from. One thread calls Next() at a time.
class FrameSource {
 public:
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  virtual ~FrameSource() = default;

  /// The next frame, nothing at the end, or an error that names the file or device. After an
  /// error the source is at its end.
  virtual Result<std::optional<Frame>> Next() = 0;

  /// A hint: frames before that of `index` are not wanted, and a source that can does not decode
  /// them. They may come all the same.
  virtual void SkipTo(std::int64_t /*index*/) {}

  /// How many frames there will be, where that is known (recordings).
  virtual std::optional<std::int64_t> FrameCount() const = 0;

  /// Whether that is what will come, rather than a container's estimate.
  virtual bool CountsExactly() const { return true; }
};

}  // namespace pleinair::devices
