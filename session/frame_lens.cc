#include "session/frame_lens.h"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

#include "compositor/lens/focus_course.h"

namespace pleinair::session {

Result<FrameLens> FrameLens::Create(const scene::SceneDescription& scene,
                                    const DefocusOptions& options, bool match_look) {
  FrameLens lens;
  if (options.mode == LensFactMode::kOff) return lens;
  if (options.mode == LensFactMode::kAuto && !match_look) return lens;
  if (options.mode == LensFactMode::kMeasured) {
    lens.may_be_measured_ = true;
    return lens;
  }
  scene::LensDescription stated = scene.camera.lens.value_or(scene::LensDescription());
  if (options.focus_dioptres) stated.focus_dioptres = {*options.focus_dioptres};
  if (options.aperture_m) stated.aperture_m = options.aperture_m;
  if (options.mode == LensFactMode::kStated && !stated.IsComplete()) {
    return InputError("--defocus stated",
                      stated.aperture_m ? "no focus is stated" : "no aperture is stated",
                      "add focus_m and aperture_mm to [lens] in the scene, or --focus and "
                      "--aperture-mm");
  }
  lens.source_ = LensFactSource::kStated;
  if (!stated.IsComplete() && scene.camera.recorded_lens) {
    // What the recording states completes what the scene leaves out.
    lens.source_ = LensFactSource::kMetadata;
    if (stated.focus_dioptres.empty())
      stated.focus_dioptres = scene.camera.recorded_lens->focus_dioptres;
    if (!stated.aperture_m) stated.aperture_m = scene.camera.recorded_lens->aperture_m;
    if (!scene.camera.lens) {
      stated.blades = scene.camera.recorded_lens->blades;
      stated.blade_rotation_deg = scene.camera.recorded_lens->blade_rotation_deg;
    }
  }
  lens.lens_ = stated;
  if (!stated.IsComplete()) {
    lens.source_ = LensFactSource::kOff;
    lens.may_be_measured_ = true;
  }
  return lens;
}

compositor::KnownLens FrameLens::Known() const {
  compositor::KnownLens known;
  known.aperture_m = lens_.aperture_m;
  // A focus that changes from frame to frame is no number that a fit could hold.
  if (lens_.focus_dioptres.size() == 1) known.focus_dioptres = lens_.focus_dioptres.front();
  return known;
}

void FrameLens::UseMeasured(const compositor::FocusFit& fit, const std::vector<FrameTime>& frames) {
  if (!fit.is_measured()) return;
  source_ = LensFactSource::kMeasured;
  lens_.aperture_m = fit.aperture_m;
  lens_.focus_dioptres = {fit.focus_dioptres};
  if (fit.changes.empty() || frames.empty()) return;
  constexpr double kPerNanosecond = 1e-9;
  lens_.focus_dioptres.assign(static_cast<std::size_t>(frames.back().frame_index) + 1,
                              fit.focus_dioptres);
  for (const FrameTime& frame : frames) {
    const double time_s = static_cast<double>(frame.timestamp_ns) * kPerNanosecond;
    lens_.focus_dioptres[static_cast<std::size_t>(frame.frame_index)] =
        compositor::FocusAtTime(fit.changes, time_s);
  }
}

std::optional<compositor::ThinLens> FrameLens::Of(std::int64_t frame_index) const {
  if (source_ == LensFactSource::kOff) return std::nullopt;
  const std::vector<double>& focus = lens_.focus_dioptres;
  const auto last = static_cast<std::int64_t>(focus.size()) - 1;
  return compositor::ThinLens{
      *lens_.aperture_m,
      focus[static_cast<std::size_t>(std::clamp<std::int64_t>(frame_index, 0, last))],
      {lens_.blades, lens_.blade_rotation_deg * std::numbers::pi / 180.0}};
}

}  // namespace pleinair::session
