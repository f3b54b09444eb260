#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "devices/images/raw_image.h"

namespace pleinair::devices {

/// The camera settings that the user can set and lock.
enum class CameraControl { kExposure, kGain, kWhiteBalance, kFocus };

/// "exposure", "gain", "white balance", "focus".
std::string_view NameOf(CameraControl control);

/// One control of a device. Units: seconds of exposure, kelvins of white balance; gain and focus in
/// device steps.
struct ControlRange {
  CameraControl control = CameraControl::kExposure;
  double lowest = 0.0;
  double highest = 0.0;
  double value = 0.0;
  bool has_auto = false;  ///< The device can choose the value automatically.
  bool is_auto = false;   ///< It does so now.
};

/// Request for one control: set a value, or lock the present one. Both turn automatic control off.
struct ControlRequest {
  CameraControl control = CameraControl::kExposure;
  std::optional<double> value;  ///< Unset: lock the value that automatic control has found.
};

/// Result of a control request.
struct ControlResult {
  CameraControl control = CameraControl::kExposure;
  std::optional<double> value;  ///< As read back from the device; unset if it lacks the control.
  bool locked = false;          ///< Automatic control is off or does not exist.
  std::string details;          ///< Deviation from the request, for the user; empty if none.
};

/// Requested image format. By default the largest size up to 1920 x 1080 that the camera delivers
/// at 25 Hz or more, uncompressed if that is as fast.
struct FormatRequest {
  std::optional<PixelFormat> format;
  std::optional<ImageSize> size;
  std::optional<double> rate_hz;
};

/// Negotiated image format.
struct NegotiatedFormat {
  PixelFormat format = PixelFormat::kYuyv;
  ImageSize size;
  std::optional<double> rate_hz;  ///< As reported by the device; it may deliver less in the dark.
  std::vector<std::string> details;  ///< Each difference between request and result, for the user.
};

struct FormatDescription {
  std::string name;                   ///< The device's own name, four letters for V4L2.
  std::optional<PixelFormat> format;  ///< Unset: not supported.
  struct Size {
    ImageSize size;
    std::vector<double> rates_hz;  ///< Descending; empty if the device does not report them.
  };
  std::vector<Size> sizes;  ///< Largest first.
};

/// A connected camera.
struct CameraDescription {
  std::string uri;   ///< Stable identity: the same after a replug or a restart.
  std::string node;  ///< Present location: "v4l2:/dev/video0"; may equal `uri`.
  std::string name;  ///< The manufacturer's name.
  std::string driver;
  std::string bus;
  std::string serial;  ///< Empty if it has none.
  std::vector<FormatDescription> formats;
  std::vector<ControlRange> controls;
  std::string trouble;  ///< Why it cannot be used now (busy, no permission); else empty.
};

}  // namespace pleinair::devices
