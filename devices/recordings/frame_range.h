#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "devices/frame_source.h"

namespace pleinair::devices {

/// A part of a recording: one frame, or those within a time.
struct FrameRange {
  std::optional<std::int64_t> frame;     ///< This frame alone.
  std::optional<std::int64_t> from_ns;   ///< First time stamp, counted as in Frame.
  std::optional<std::int64_t> until_ns;  ///< Last time stamp.

  bool IsAll() const { return !frame && !from_ns && !until_ns; }
  bool Contains(std::int64_t index, std::int64_t timestamp_ns) const {
    if (frame) return index == *frame;
    return (!from_ns || timestamp_ns >= *from_ns) && (!until_ns || timestamp_ns <= *until_ns);
  }
};

/// Delivers the frames of a range, with the indices and time stamps of the whole recording. Sources
/// that know their time stamps do not decode the frames before it. Error from Next(): the recording
/// `name` has no frame in the range.
std::unique_ptr<FrameSource> LimitFrames(std::unique_ptr<FrameSource> frames, FrameRange range,
                                         std::string name);

}  // namespace pleinair::devices
