#include "devices/cameras/v4l2/v4l2_controls.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "devices/cameras/v4l2/v4l2_status.h"

namespace pleinair::devices {
namespace {

/// V4L2's name of one of our controls.
struct Mapping {
  CameraControl control;
  __u32 value_id;
  __u32 auto_id;
  double unit;  ///< Ours per step of the device's.
};

// V4L2_CID_EXPOSURE_ABSOLUTE is in units of 100 microseconds, WHITE_BALANCE_TEMPERATURE in kelvins.
constexpr Mapping kMappings[] = {
    {CameraControl::kExposure, V4L2_CID_EXPOSURE_ABSOLUTE, V4L2_CID_EXPOSURE_AUTO, 1e-4},
    {CameraControl::kGain, V4L2_CID_GAIN, V4L2_CID_AUTOGAIN, 1.0},
    {CameraControl::kWhiteBalance, V4L2_CID_WHITE_BALANCE_TEMPERATURE, V4L2_CID_AUTO_WHITE_BALANCE,
     1.0},
    {CameraControl::kFocus, V4L2_CID_FOCUS_ABSOLUTE, V4L2_CID_FOCUS_AUTO, 1.0}};

const Mapping& MappingOf(CameraControl control) {
  return *std::find_if(std::begin(kMappings), std::end(kMappings),
                       [&](const Mapping& mapping) { return mapping.control == control; });
}

bool Query(const V4l2Node& node, __u32 id, v4l2_queryctrl* query) {
  *query = {};
  query->id = id;
  return node.Control(VIDIOC_QUERYCTRL, query) >= 0 &&
         (query->flags & V4L2_CTRL_FLAG_DISABLED) == 0;
}

std::optional<int> Get(const V4l2Node& node, __u32 id) {
  v4l2_control control{};
  control.id = id;
  if (node.Control(VIDIOC_G_CTRL, &control) < 0) return std::nullopt;
  return control.value;
}

int Set(const V4l2Node& node, __u32 id, int value) {
  v4l2_control control{};
  control.id = id;
  control.value = value;
  return node.Control(VIDIOC_S_CTRL, &control);
}

/// Exposure is a menu with two non-automatic modes; the others are switches.
bool MeansAuto(const Mapping& mapping, int value) {
  if (mapping.control != CameraControl::kExposure) return value != 0;
  return value == V4L2_EXPOSURE_AUTO || value == V4L2_EXPOSURE_APERTURE_PRIORITY;
}

int ValueForManual(const Mapping& mapping) {
  return mapping.control == CameraControl::kExposure ? V4L2_EXPOSURE_MANUAL : 0;
}

ControlResult Fulfil(const V4l2Node& node, const ControlRequest& requested) {
  const Mapping& mapping = MappingOf(requested.control);
  const std::string name(NameOf(requested.control));
  ControlResult result;
  result.control = requested.control;
  v4l2_queryctrl range{}, automatic{};
  if (!Query(node, mapping.value_id, &range)) {
    result.details = "the camera has no control of its " + name;
    return result;
  }
  // Read before automatic control is turned off: this is the value to lock.
  const std::optional<int> found = Get(node, mapping.value_id);
  bool is_auto = false;
  if (Query(node, mapping.auto_id, &automatic)) {
    const int failed = Set(node, mapping.auto_id, ValueForManual(mapping));
    if (failed < 0) {
      result.details = V4l2Error(node.path(), name + " cannot be locked", -failed).Message();
    }
    const std::optional<int> now = Get(node, mapping.auto_id);
    is_auto = now && MeansAuto(mapping, *now);
  }
  std::optional<int> wanted = found;
  if (requested.value) {
    const double steps = std::round(*requested.value / mapping.unit);
    wanted = static_cast<int>(
        std::clamp(steps, static_cast<double>(range.minimum), static_cast<double>(range.maximum)));
    if (*wanted != steps) {
      result.details = name + " goes from " + std::to_string(range.minimum * mapping.unit) +
                       " to " + std::to_string(range.maximum * mapping.unit);
    }
  }
  if (wanted && !is_auto) {
    const int failed = Set(node, mapping.value_id, *wanted);
    if (failed < 0) {
      result.details = V4l2Error(node.path(), name + " cannot be set", -failed).Message();
    }
  }
  if (const std::optional<int> now = Get(node, mapping.value_id)) {
    result.value = *now * mapping.unit;
  }
  result.locked = !is_auto;
  if (is_auto && result.details.empty()) result.details = name + " keeps changing by itself";
  return result;
}

}  // namespace

std::vector<ControlRange> V4l2Controls(const V4l2Node& node) {
  std::vector<ControlRange> controls;
  for (const Mapping& mapping : kMappings) {
    v4l2_queryctrl query{};
    if (!Query(node, mapping.value_id, &query)) continue;
    ControlRange range;
    range.control = mapping.control;
    range.lowest = query.minimum * mapping.unit;
    range.highest = query.maximum * mapping.unit;
    range.value = Get(node, mapping.value_id).value_or(query.default_value) * mapping.unit;
    range.has_auto = Query(node, mapping.auto_id, &query);
    const std::optional<int> automatic = Get(node, mapping.auto_id);
    range.is_auto = range.has_auto && automatic && MeansAuto(mapping, *automatic);
    controls.push_back(range);
  }
  return controls;
}

std::vector<ControlResult> LockV4l2Controls(const V4l2Node& node,
                                            const std::vector<ControlRequest>& control_requests) {
  std::vector<ControlResult> results;
  results.reserve(control_requests.size());
  for (const ControlRequest& requested : control_requests)
    results.push_back(Fulfil(node, requested));
  return results;
}

}  // namespace pleinair::devices
