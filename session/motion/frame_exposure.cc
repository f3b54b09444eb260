#include "session/motion/frame_exposure.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pleinair::session {

Result<FrameExposure> FrameExposure::Create(const scene::SceneDescription& scene,
                                            const MotionBlurOptions& options, bool match_look) {
  FrameExposure exposure;
  if (options.mode == LensFactMode::kOff) return exposure;
  if (options.mode == LensFactMode::kAuto && !match_look) return exposure;
  exposure.is_off_ = false;
  if (options.mode == LensFactMode::kMeasured) {
    exposure.may_be_measured_ = true;
    return exposure;
  }
  const auto use = [&](LensFactSource source, std::vector<double> exposures_s) {
    exposure.source_ = source;
    exposure.exposures_s_ = std::move(exposures_s);
  };
  if (options.exposure_s) {
    use(LensFactSource::kStated, {*options.exposure_s});
  } else if (scene.camera.lens && !scene.camera.lens->exposure_s.empty()) {
    use(LensFactSource::kStated, scene.camera.lens->exposure_s);
  } else if (options.mode == LensFactMode::kStated) {
    return InputError("--motion-blur stated", "no exposure is stated",
                      "add exposure_ms to [lens] in the scene, or --exposure-ms");
  } else if (scene.camera.recorded_lens && !scene.camera.recorded_lens->exposure_s.empty()) {
    use(LensFactSource::kMetadata, scene.camera.recorded_lens->exposure_s);
  } else {
    exposure.uses_own_ = exposure.may_be_measured_ = true;
  }
  return exposure;
}

void FrameExposure::UseMeasured(const compositor::ExposureFit& fit) {
  if (!fit.is_measured()) return;
  source_ = LensFactSource::kMeasured;
  exposures_s_ = {fit.exposure_s};
}

FrameExposure::Exposure FrameExposure::Of(std::int64_t frame_index,
                                          const std::optional<double>& own_s) const {
  if (uses_own_ && own_s && *own_s > 0.0) return {LensFactSource::kMetadata, *own_s};
  if (exposures_s_.empty()) return {};
  const auto last = static_cast<std::int64_t>(exposures_s_.size()) - 1;
  const auto at = static_cast<std::size_t>(std::clamp<std::int64_t>(frame_index, 0, last));
  return {source_, exposures_s_[at]};
}

}  // namespace pleinair::session
