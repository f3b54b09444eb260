#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "base/image.h"
#include "devices/images/raw_image.h"

namespace pleinair::devices {

/// What a frame's time stamp marks.
enum class StampMeaning { kUnknown, kExposureStart, kExposureEnd, kArrival };

/// Frames that never reached us, by how that is known; each is counted once.
struct FrameLoss {
  int by_number = 0;  ///< The driver's numbers jump: it had no free buffer or dropped it.
  int by_time = 0;    ///< The numbers go on but the stamps jump: lost before the driver.
  int damaged = 0;    ///< Came marked as damaged, or could not be decoded.
  int not_taken = 0;  ///< Came whole and was replaced by a newer one before anyone asked.

  int Total() const { return by_number + by_time + damaged + not_taken; }
  FrameLoss& operator+=(const FrameLoss& other) {
    by_number += other.by_number;
    by_time += other.by_time;
    damaged += other.damaged;
    not_taken += other.not_taken;
    return *this;
  }
  bool operator==(const FrameLoss&) const = default;
};

/// How a camera was set for an image; nothing where that is not known or an automatism changes it.
struct CameraSettings {
  std::optional<double> exposure_s;
  std::optional<double> gain;             ///< In the camera's unit.
  std::optional<double> white_balance_k;  ///< Color temperature, in kelvins.

  bool operator==(const CameraSettings&) const = default;
};

/// One image from a camera or a recording, as every backend delivers it.
struct Frame {
  std::int64_t index = 0;         ///< Position in the recording or the driver's number, from 0.
  std::int64_t timestamp_ns = 0;  ///< Steady clock (camera) or since the recording's start.
  StampMeaning stamp_meaning = StampMeaning::kUnknown;
  std::optional<std::int64_t> arrival_ns;  ///< When it came to us, same clock as timestamp_ns.
  std::optional<std::int64_t> device_timestamp_ns;  ///< The device's own stamp, where it has one.
  CameraSettings settings;
  int lost_before = 0;  ///< Frames known to be lost between the one before and this one.
  FrameLoss loss;       ///< The same by cause, where the source knows.
  RgbImage rgb;         ///< Three channels, sRGB-encoded.
  GreyImage grey;       ///< One channel, sRGB-encoded: what the tracker looks at.
  /// The bytes that the camera sent, which a recorder keeps; null for files.
  std::shared_ptr<const RawImage> raw;
};

}  // namespace pleinair::devices
