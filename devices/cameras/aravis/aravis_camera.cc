#include "devices/cameras/aravis/aravis_camera.h"

#include <algorithm>
#include <string>

namespace pleinair::devices {
namespace {

constexpr AravisFormat kFormats[] = {{ARV_PIXEL_FORMAT_MONO_8, PixelFormat::kGrey8},
                                     {ARV_PIXEL_FORMAT_BAYER_RG_8, PixelFormat::kBayerRggb8},
                                     {ARV_PIXEL_FORMAT_BAYER_BG_8, PixelFormat::kBayerBggr8},
                                     {ARV_PIXEL_FORMAT_BAYER_GB_8, PixelFormat::kBayerGbrg8},
                                     {ARV_PIXEL_FORMAT_BAYER_GR_8, PixelFormat::kBayerGrbg8},
                                     {ARV_PIXEL_FORMAT_RGB_8_PACKED, PixelFormat::kRgb24},
                                     {ARV_PIXEL_FORMAT_BGR_8_PACKED, PixelFormat::kBgr24},
                                     {ARV_PIXEL_FORMAT_YUV_422_PACKED, PixelFormat::kUyvy},
                                     {ARV_PIXEL_FORMAT_YUV_422_YUYV_PACKED, PixelFormat::kYuyv}};

/// GenICam's exposure is in microseconds.
constexpr double kMicrosecond = 1e-6;

ControlResult Fulfil(ArvCamera* camera, const ControlRequest& requested) {
  ControlResult result;
  result.control = requested.control;
  const std::string name(NameOf(requested.control));
  GErrorSlot error;
  const bool exposure = requested.control == CameraControl::kExposure;
  const bool there = exposure
                         ? arv_camera_is_exposure_time_available(camera, error.Fresh()) != FALSE
                         : requested.control == CameraControl::kGain &&
                               arv_camera_is_gain_available(camera, error.Fresh()) != FALSE;
  if (!there) {
    result.details = "the camera has no control of its " + name;
    return result;
  }
  const auto auto_available =
      exposure ? arv_camera_is_exposure_auto_available : arv_camera_is_gain_auto_available;
  const auto set_auto = exposure ? arv_camera_set_exposure_time_auto : arv_camera_set_gain_auto;
  const auto set = exposure ? arv_camera_set_exposure_time : arv_camera_set_gain;
  const auto get = exposure ? arv_camera_get_exposure_time : arv_camera_get_gain;
  const double unit = exposure ? kMicrosecond : 1.0;
  result.locked = true;
  if (auto_available(camera, error.Fresh()) != FALSE) {
    set_auto(camera, ARV_AUTO_OFF, error.Fresh());
    if (error.failed()) {
      result.locked = false;
      result.details = name + " cannot be locked: " + error.details();
    }
  }
  if (requested.value) {
    set(camera, *requested.value / unit, error.Fresh());
    if (error.failed()) result.details = name + " cannot be set: " + error.details();
  }
  const double now = get(camera, error.Fresh()) * unit;
  if (!error.failed()) result.value = now;
  return result;
}

}  // namespace

std::optional<AravisFormat> AravisFormatOf(ArvPixelFormat theirs) {
  for (const AravisFormat& format : kFormats) {
    if (format.theirs == theirs) return format;
  }
  return std::nullopt;
}

std::optional<AravisFormat> AravisFormatOf(PixelFormat ours) {
  for (const AravisFormat& format : kFormats) {
    if (format.ours == ours) return format;
  }
  return std::nullopt;
}

std::vector<FormatDescription> AravisFormats(ArvCamera* camera) {
  GErrorSlot error;
  guint count = 0, name_count = 0;
  const std::unique_ptr<gint64, decltype(&g_free)> codes(
      arv_camera_dup_available_pixel_formats(camera, &count, error.Fresh()), g_free);
  const std::unique_ptr<const char*, decltype(&g_free)> names(
      arv_camera_dup_available_pixel_formats_as_strings(camera, &name_count, error.Fresh()),
      g_free);
  gint width = 0, height = 0, smallest = 0;
  arv_camera_get_width_bounds(camera, &smallest, &width, error.Fresh());
  arv_camera_get_height_bounds(camera, &smallest, &height, error.Fresh());
  double slowest_hz = 0.0, fastest_hz = 0.0;
  std::vector<double> rates_hz;
  if (arv_camera_is_frame_rate_available(camera, error.Fresh()) != FALSE) {
    arv_camera_get_frame_rate_bounds(camera, &slowest_hz, &fastest_hz, error.Fresh());
    if (!error.failed() && fastest_hz > slowest_hz) rates_hz = {fastest_hz, slowest_hz};
  }
  std::vector<FormatDescription> formats;
  for (guint i = 0; i < std::min(count, name_count); ++i) {
    const auto known = AravisFormatOf(static_cast<ArvPixelFormat>(codes.get()[i]));
    formats.push_back({names.get()[i],
                       known ? std::optional(known->ours) : std::nullopt,
                       {{ImageSize{width, height}, rates_hz}}});
  }
  return formats;
}

std::vector<ControlRange> AravisControls(ArvCamera* camera) {
  std::vector<ControlRange> controls;
  GErrorSlot error;
  if (arv_camera_is_exposure_time_available(camera, error.Fresh()) != FALSE) {
    ControlRange range;
    range.control = CameraControl::kExposure;
    arv_camera_get_exposure_time_bounds(camera, &range.lowest, &range.highest, error.Fresh());
    range.value = arv_camera_get_exposure_time(camera, error.Fresh()) * kMicrosecond;
    range.lowest *= kMicrosecond;
    range.highest *= kMicrosecond;
    range.has_auto = arv_camera_is_exposure_auto_available(camera, error.Fresh()) != FALSE;
    range.is_auto =
        range.has_auto && arv_camera_get_exposure_time_auto(camera, error.Fresh()) != ARV_AUTO_OFF;
    controls.push_back(range);
  }
  if (arv_camera_is_gain_available(camera, error.Fresh()) != FALSE) {
    ControlRange range;
    range.control = CameraControl::kGain;
    arv_camera_get_gain_bounds(camera, &range.lowest, &range.highest, error.Fresh());
    range.value = arv_camera_get_gain(camera, error.Fresh());
    range.has_auto = arv_camera_is_gain_auto_available(camera, error.Fresh()) != FALSE;
    range.is_auto =
        range.has_auto && arv_camera_get_gain_auto(camera, error.Fresh()) != ARV_AUTO_OFF;
    controls.push_back(range);
  }
  return controls;
}

std::vector<ControlResult> LockAravisControls(ArvCamera* camera,
                                              const std::vector<ControlRequest>& control_requests) {
  std::vector<ControlResult> results;
  results.reserve(control_requests.size());
  for (const ControlRequest& requested : control_requests)
    results.push_back(Fulfil(camera, requested));
  return results;
}

}  // namespace pleinair::devices
