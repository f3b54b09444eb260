#include "devices/cameras/camera.h"

namespace pleinair::devices {

std::string_view NameOf(CameraControl control) {
  switch (control) {
    case CameraControl::kExposure:
      return "exposure";
    case CameraControl::kGain:
      return "gain";
    case CameraControl::kWhiteBalance:
      return "white balance";
    case CameraControl::kFocus:
      return "focus";
  }
  return "";
}

}  // namespace pleinair::devices
