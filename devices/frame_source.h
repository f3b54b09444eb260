#pragma once

#include <cstdint>
#include <optional>

#include "base/error.h"
#include "devices/frame.h"

namespace pleinair::devices {

/// Source of frames: a camera or a recording. Next() must not be called by two threads at once.
class FrameSource {
 public:
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  virtual ~FrameSource() = default;

  /// Returns the next frame, nullopt at the end, or an error that names the file or device. After
  /// an error the source is at its end.
  virtual Result<std::optional<Frame>> Next() = 0;

  /// Hint that frames before `index` are not needed. A source may skip decoding them; it may also
  /// deliver them.
  virtual void SkipTo(std::int64_t /*index*/) {}

  /// Index of the first frame whose time stamp is not before a time; the number of frames if there
  /// is none. Nullopt: not known without decoding.
  virtual std::optional<std::int64_t> FirstFrameFrom(std::int64_t /*timestamp_ns*/) const {
    return std::nullopt;
  }

  /// Total number of frames, if known (recordings).
  virtual std::optional<std::int64_t> FrameCount() const = 0;

  /// True if that number is exact; false if it is a container's estimate.
  virtual bool CountsExactly() const { return true; }
};

}  // namespace pleinair::devices
