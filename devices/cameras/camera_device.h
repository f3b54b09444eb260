#pragma once

// Internal: between the .cc files of this module; not installed.

#include <chrono>
#include <memory>

#include "devices/cameras/camera.h"
#include "devices/cameras/camera_counts.h"
#include "devices/cameras/camera_uri.h"
#include "devices/frame.h"

namespace pleinair::devices {

/// Now, on the clock of frames' stamps.
inline std::int64_t SteadyNow_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// What a backend hands on: the bytes and what the driver says of them. Reused from image to
/// image.
struct CapturedImage {
  RawImage raw;
  std::int64_t number = 0;        ///< The driver's; gaps are losses.
  std::int64_t timestamp_ns = 0;  ///< Steady clock.
  std::int64_t arrival_ns = 0;    ///< Steady clock.
  StampMeaning stamp_meaning = StampMeaning::kUnknown;
  std::optional<std::int64_t> device_timestamp_ns;
  CameraSettings settings;
  bool damaged = false;  ///< The driver's word; `raw` may be short.
};

enum class WaitOutcome {
  kImage,
  kNothing,  ///< Time is over or Wake() was called.
  kGone,     ///< The device left or answers no more; only closing it helps.
};

/// One opened, streaming device of a backend. Wake() may be called from any thread, the rest from
/// one. Destruction stops the stream and gives everything back in bounded time.
class CameraDevice {
 public:
  virtual ~CameraDevice() = default;

  virtual WaitOutcome Wait(std::chrono::milliseconds limit, CapturedImage* image) = 0;
  virtual void Wake() = 0;
  /// Why Wait() gave kGone.
  virtual std::string StatusMessage() const = 0;

  virtual const NegotiatedFormat& negotiated() const = 0;
  /// Stable name, to find it by after a replug.
  virtual CameraUri identity() const = 0;

  virtual std::optional<TransportCounts> Transport() { return std::nullopt; }
  virtual std::vector<ControlRange> Controls() = 0;
  virtual std::vector<ControlResult> LockControls(
      const std::vector<ControlRequest>& control_requests) = 0;
};

}  // namespace pleinair::devices
