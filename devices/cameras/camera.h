#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "devices/images/raw_image.h"

namespace pleinair::devices {

/// What a person may set and hold on a camera.
enum class CameraControl { kExposure, kGain, kWhiteBalance, kFocus };

/// "exposure", "gain", "white balance", "focus".
std::string_view NameOf(CameraControl control);

/// One control as a device has it. Units: seconds of exposure, kelvins of white balance; gain and
/// focus count in steps of the device's own.
struct ControlRange {
  CameraControl control = CameraControl::kExposure;
  double lowest = 0.0;
  double highest = 0.0;
  double value = 0.0;
  bool has_auto = false;  ///< The device can find the value by itself.
  bool is_auto = false;   ///< It does so now.
};

/// Wish for one control: a value, or the present one held, in both cases without automatism.
struct ControlRequest {
  CameraControl control = CameraControl::kExposure;
  std::optional<double> value;  ///< Nothing: hold what the automatism has found.
};

/// What became of a wish.
struct ControlResult {
  CameraControl control = CameraControl::kExposure;
  std::optional<double> value;  ///< As read back from the device; nothing where it lacks it.
  bool locked = false;          ///< Its automatism is off, or it has none.
  std::string details;          ///< What a person should know; empty where all went as wished.
};

/// What is asked of a camera's pictures. Where nothing is asked, the largest size of at most
/// 1920 x 1080 that comes at 25 Hz or more, uncompressed where that comes as fast.
struct FormatRequest {
  std::optional<PixelFormat> format;
  std::optional<ImageSize> size;
  std::optional<double> rate_hz;
};

/// What came of it.
struct NegotiatedFormat {
  PixelFormat format = PixelFormat::kYuyv;
  ImageSize size;
  std::optional<double> rate_hz;     ///< As the device says; it may deliver less in the dark.
  std::vector<std::string> details;  ///< Each difference between asked and got, for a person.
};

struct FormatDescription {
  std::string name;                   ///< The device's own, four letters for V4L2.
  std::optional<PixelFormat> format;  ///< Nothing: we cannot read it.
  struct Size {
    ImageSize size;
    std::vector<double> rates_hz;  ///< Descending; empty where the device does not say.
  };
  std::vector<Size> sizes;  ///< Largest first.
};

/// One camera that is there.
struct CameraDescription {
  std::string uri;   ///< By identity: the same after a replug or a restart.
  std::string node;  ///< Where it is now: "v4l2:/dev/video0"; may equal `uri`.
  std::string name;  ///< The maker's.
  std::string driver;
  std::string bus;
  std::string serial;  ///< Empty where it has none.
  std::vector<FormatDescription> formats;
  std::vector<ControlRange> controls;
  std::string trouble;  ///< Why it cannot be used now (busy, no permission); else empty.
};

}  // namespace pleinair::devices
