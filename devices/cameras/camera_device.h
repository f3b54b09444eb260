#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <chrono>
#include <memory>

#include "devices/cameras/camera.h"
#include "devices/cameras/camera_counts.h"
#include "devices/cameras/camera_uri.h"
#include "devices/frame.h"

namespace pleinair::devices {

/// Present time on the clock of the frames' time stamps.
inline std::int64_t SteadyNow_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// An image from a backend: its bytes and the driver's metadata. Reused from image to image.
struct CapturedImage {
  RawImage raw;
  std::int64_t number = 0;        ///< The driver's number; gaps are lost frames.
  std::int64_t timestamp_ns = 0;  ///< Steady clock.
  std::int64_t arrival_ns = 0;    ///< Steady clock.
  StampMeaning stamp_meaning = StampMeaning::kUnknown;
  std::optional<std::int64_t> device_timestamp_ns;
  CameraSettings settings;
  bool damaged = false;  ///< As reported by the driver; `raw` may then be short.
};

enum class WaitOutcome {
  kImage,
  kNothing,  ///< Timeout, or Wake() was called.
  kGone,     ///< The device is gone or no longer answers; close it.
};

/// An open, streaming device of a backend. Wake() may be called from any thread, the rest from one.
/// The destructor stops the stream and releases everything in bounded time.
class CameraDevice {
 public:
  virtual ~CameraDevice() = default;

  virtual WaitOutcome Wait(std::chrono::milliseconds limit, CapturedImage* image) = 0;
  virtual void Wake() = 0;
  /// Reason why Wait() returned kGone.
  virtual std::string StatusMessage() const = 0;

  virtual const NegotiatedFormat& negotiated() const = 0;
  /// Stable name, used to find the device after a replug.
  virtual CameraUri identity() const = 0;

  virtual std::optional<TransportCounts> Transport() { return std::nullopt; }
  virtual std::vector<ControlRange> Controls() = 0;
  virtual std::vector<ControlResult> LockControls(
      const std::vector<ControlRequest>& control_requests) = 0;
};

}  // namespace pleinair::devices
