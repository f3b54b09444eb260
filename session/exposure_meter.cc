#include "session/exposure_meter.h"

namespace pleinair::session {

void ExposureMeter::Read(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
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
                            ? meter_->Measure(rgb, camera, *camera_from_marker)
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
  if (!filter_.empty()) summary->exposure_scale_error = filter_.Error();
  summary->exposures.change = filter_.Change();
}

}  // namespace pleinair::session
