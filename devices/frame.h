#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "base/camera_image.h"
#include "base/image.h"
#include "devices/images/raw_image.h"

namespace pleinair::devices {

/// The event that a frame's time stamp marks.
enum class StampMeaning { kUnknown, kExposureStart, kExposureEnd, kArrival };

/// Lost frames, by the way the loss was detected; each is counted once.
struct FrameLoss {
  int by_number = 0;  ///< Gap in the driver's numbers: it had no free buffer or dropped the frame.
  int by_time = 0;    ///< Consecutive numbers but a gap in the time stamps: lost before the driver.
  int damaged = 0;    ///< Marked as damaged, or could not be decoded.
  int not_taken = 0;  ///< Complete, but replaced by a newer frame before it was read.

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

/// Camera settings of a frame. Unset if unknown or under automatic control.
struct CameraSettings {
  std::optional<double> exposure_s;
  std::optional<double> gain;             ///< In the camera's unit.
  std::optional<double> white_balance_k;  ///< Color temperature, in kelvins.

  bool operator==(const CameraSettings&) const = default;
};

/// One image from a camera or a recording, in the form that every backend delivers.
struct Frame {
  std::int64_t index = 0;         ///< Position in the recording, or the driver's number, from 0.
  std::int64_t timestamp_ns = 0;  ///< Steady clock (camera), or time since the start of the
                                  ///< recording.
  StampMeaning stamp_meaning = StampMeaning::kUnknown;
  std::optional<std::int64_t> arrival_ns;  ///< Time of arrival, same clock as timestamp_ns.
  std::optional<std::int64_t> device_timestamp_ns;  ///< The device's own time stamp, if it has one.
  CameraSettings settings;
  int lost_before = 0;  ///< Frames known to be lost between the previous frame and this one.
  FrameLoss loss;       ///< The same losses by cause, if the source reports them.
  RgbImage rgb;         ///< Three channels, sRGB-encoded.
  DeepImage deep;       ///< The same in 16 bits; empty: the source has 8, unconverted.
  GreyImage grey;       ///< One channel, sRGB-encoded; input of the tracker.
  /// The bytes that the camera sent, for recorders; null for files.
  std::shared_ptr<const RawImage> raw;
};

/// The frame's image, at its source's depth.
inline CameraImageView ImageOf(const Frame& frame) { return {frame.rgb.view(), frame.deep.view()}; }

}  // namespace pleinair::devices
