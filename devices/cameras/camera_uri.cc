#include "devices/cameras/camera_uri.h"

namespace pleinair::devices {
namespace {

using Backend = CameraUri::Backend;
using Key = CameraUri::Key;

constexpr const char* kExamples =
    "write v4l2:/dev/video0, v4l2:serial=NUMBER, v4l2:bus=PATH, libcamera:ID, aravis:ID or "
    "file:PATH; 'pleinair devices' lists what is there";

struct Scheme {
  std::string_view name;
  Backend backend;
  Key key;
};
constexpr Scheme kSchemes[] = {{"v4l2", Backend::kV4l2, Key::kNode},
                               {"libcamera", Backend::kLibcamera, Key::kId},
                               {"aravis", Backend::kAravis, Key::kId},
                               {"file", Backend::kFile, Key::kPath}};
constexpr std::string_view kSerial = "serial=";
constexpr std::string_view kBus = "bus=";

}  // namespace

std::string CameraUri::ToString() const {
  std::string text;
  for (const Scheme& scheme : kSchemes) {
    if (scheme.backend == backend) text = scheme.name;
  }
  text += ':';
  if (key == Key::kSerial) text += kSerial;
  if (key == Key::kBus) text += kBus;
  return text + value;
}

Result<CameraUri> ParseCameraUri(std::string_view text) {
  const auto fail = [&](const char* what) {
    return InputError("", "camera \"" + std::string(text.substr(0, 200)) + "\" " + what, kExamples);
  };
  for (const Scheme& scheme : kSchemes) {
    if (!text.starts_with(scheme.name) || text.substr(scheme.name.size(), 1) != ":") continue;
    std::string_view value = text.substr(scheme.name.size() + 1);
    Key key = scheme.key;
    if (scheme.backend == Backend::kV4l2) {
      if (value.starts_with(kSerial)) {
        key = Key::kSerial;
        value.remove_prefix(kSerial.size());
      } else if (value.starts_with(kBus)) {
        key = Key::kBus;
        value.remove_prefix(kBus.size());
      } else if (!value.empty() && !value.starts_with("/dev/")) {
        return fail("names no device: it begins neither with /dev/ nor with serial= or bus=");
      }
    }
    if (value.empty()) return fail("names nothing after the colon");
    return CameraUri{scheme.backend, key, std::string(value)};
  }
  return fail("is of an unknown kind");
}

}  // namespace pleinair::devices
