#pragma once

#include <cstdint>
#include <optional>

#include "base/image.h"

namespace pleinair::devices {

/// What a frame's time stamp marks.
enum class StampMeaning { kUnknown, kExposureStart, kExposureEnd, kArrival };

/// One picture from a camera or a recording, as every backend delivers it.
struct Frame {
  std::int64_t index = 0;         ///< Position in the recording or sequence number, from 0.
  std::int64_t timestamp_ns = 0;  ///< Steady clock (camera) or since the recording's start.
  StampMeaning stamp_meaning = StampMeaning::kUnknown;
  std::optional<std::int64_t> device_timestamp_ns;  ///< The device's own stamp, where it has one.
  std::optional<double> exposure_s;
  std::optional<double> gain;
  int lost_before = 0;  ///< Frames known to be lost between the one before and this one.
  RgbImage rgb;         ///< Three channels, sRGB-encoded.
  GreyImage grey;       ///< One channel, sRGB-encoded: what the tracker looks at.
};

}  // namespace pleinair::devices
