#include "devices/cameras/libcamera/libcamera_controls.h"

#include <libcamera/control_ids.h>

#include <algorithm>
#include <cmath>

namespace pleinair::devices {
namespace {

/// libcamera's name of one of our controls. It sets white balance by gains of red and blue, not by
/// a color temperature.
struct Mapping {
  CameraControl control;
  const libcamera::ControlId* value;
  const libcamera::ControlId* automatic;
  double unit;  ///< Ours per step of libcamera's.
};

const Mapping kMappings[] = {
    {CameraControl::kExposure, &libcamera::controls::ExposureTime, &libcamera::controls::AeEnable,
     1e-6},
    {CameraControl::kGain, &libcamera::controls::AnalogueGain, &libcamera::controls::AeEnable, 1.0},
    {CameraControl::kFocus, &libcamera::controls::LensPosition, &libcamera::controls::AfMode, 1.0}};

double NumberOf(const libcamera::ControlValue& value) {
  if (value.type() == libcamera::ControlTypeInteger32) return value.get<std::int32_t>();
  if (value.type() == libcamera::ControlTypeFloat) return value.get<float>();
  return 0.0;
}

}  // namespace

std::vector<ControlRange> LibcameraControls(const libcamera::ControlInfoMap& infos) {
  std::vector<ControlRange> controls;
  for (const Mapping& mapping : kMappings) {
    const auto info = infos.find(mapping.value);
    if (info == infos.end()) continue;
    ControlRange range;
    range.control = mapping.control;
    range.lowest = NumberOf(info->second.min()) * mapping.unit;
    range.highest = NumberOf(info->second.max()) * mapping.unit;
    range.value = NumberOf(info->second.def()) * mapping.unit;
    range.has_auto = range.is_auto = infos.find(mapping.automatic) != infos.end();
    controls.push_back(range);
  }
  return controls;
}

std::optional<ControlResult> RequestLibcameraControl(const libcamera::ControlInfoMap& infos,
                                                     const ControlRequest& requested,
                                                     std::optional<double> now,
                                                     libcamera::ControlList* request) {
  for (const Mapping& mapping : kMappings) {
    const auto info = infos.find(mapping.value);
    if (mapping.control != requested.control || info == infos.end()) continue;
    ControlResult result;
    result.control = requested.control;
    result.locked = true;
    if (infos.find(mapping.automatic) != infos.end()) {
      if (mapping.automatic == &libcamera::controls::AfMode) {
        request->set(libcamera::controls::AfMode, libcamera::controls::AfModeManual);
      } else {
        request->set(libcamera::controls::AeEnable, false);
      }
    }
    const std::optional<double> wanted = requested.value ? requested.value : now;
    if (!wanted) return result;
    const double lowest = NumberOf(info->second.min()), highest = NumberOf(info->second.max());
    const double steps = std::clamp(*wanted / mapping.unit, lowest, highest);
    if (mapping.value->type() == libcamera::ControlTypeInteger32) {
      const double whole = std::round(steps);
      request->set(mapping.value->id(), libcamera::ControlValue(static_cast<std::int32_t>(whole)));
      result.value = whole * mapping.unit;
    } else {
      request->set(mapping.value->id(), libcamera::ControlValue(static_cast<float>(steps)));
      result.value = steps * mapping.unit;
    }
    return result;
  }
  return std::nullopt;
}

}  // namespace pleinair::devices
