#include "session/exposure_meter.h"

#include <cmath>

namespace pleinair::session {
namespace {

// Relative standard deviations that no further frame reduces. The first is that of the marker's
// stated reflectance and of the light on it. The second is a part of the logarithm of the
// correction for a marker in shade. Both by made scenes (docs/measurements/light.md#calibration).
constexpr double kMarkerError = 0.03, kShadeError = 0.15;

LinearRgb WithDoubt(LinearRgb error, LinearRgb marker_shade) {
  const double doubt = std::hypot(kMarkerError, kShadeError * MeanLog(marker_shade));
  return {std::hypot(error.r, doubt), std::hypot(error.g, doubt), std::hypot(error.b, doubt)};
}

}  // namespace

void ExposureMeter::Read(CameraImageView image, const CameraModel& camera,
                         const std::optional<Transform<Camera, Marker>>& camera_from_marker,
                         LinearRgb marker_shade, const FollowedLight& followed,
                         LightSummary* summary) {
  using ExposureScaleSource = LightSummary::ExposureScaleSource;
  if (locked_ && (holds_ || !filter_.empty())) {
    summary->exposure_scale = last_ * followed.exposure;
    return;
  }
  is_used_ = true;
  const auto estimate = meter_ && camera_from_marker
                            ? meter_->Measure(image, camera, *camera_from_marker)
                            : std::nullopt;
  if (estimate) {
    filter_.Add(estimate->exposure_scale * marker_shade / followed.marker_light, estimate->error);
    ++summary->exposures.estimates;
    summary->exposures.dappled += estimate->dappled ? 1 : 0;
    summary->exposures.sunlit_share = estimate->sunlit_share;
  }
  summary->exposure_scale_source =
      filter_.empty() ? ExposureScaleSource::kGuess : ExposureScaleSource::kMarker;
  last_ = filter_.empty() ? guess_ : filter_.ExposureScale();
  summary->exposure_scale = last_ * followed.exposure;
  if (!filter_.empty()) {
    summary->exposure_scale_error = WithDoubt(filter_.Error(), marker_shade);
  }
  summary->exposures.change = filter_.Change();
}

}  // namespace pleinair::session
