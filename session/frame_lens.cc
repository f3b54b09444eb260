#include "session/frame_lens.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

namespace pleinair::session {

const char* NameOf(DefocusSource source) {
  if (source == DefocusSource::kOff) return "off";
  return source == DefocusSource::kStated ? "stated" : "metadata";
}

Result<FrameLens> FrameLens::Create(const scene::SceneDescription& scene,
                                    const DefocusOptions& options, bool match_look) {
  FrameLens lens;
  if (options.mode == DefocusMode::kOff) return lens;
  if (options.mode == DefocusMode::kAuto && !match_look) return lens;
  scene::LensDescription stated = scene.camera.lens.value_or(scene::LensDescription());
  if (options.focus_dioptres) stated.focus_dioptres = {*options.focus_dioptres};
  if (options.aperture_m) stated.aperture_m = options.aperture_m;
  if (options.mode == DefocusMode::kStated && !stated.IsComplete()) {
    return InputError("--defocus stated",
                      stated.aperture_m ? "no focus is stated" : "no aperture is stated",
                      "add focus_m and aperture_mm to [lens] in the scene, or --focus and "
                      "--aperture-mm");
  }
  lens.source_ = DefocusSource::kStated;
  if (!stated.IsComplete() && scene.camera.recorded_lens) {
    // What the recording states completes what the scene leaves out.
    lens.source_ = DefocusSource::kMetadata;
    if (stated.focus_dioptres.empty())
      stated.focus_dioptres = scene.camera.recorded_lens->focus_dioptres;
    if (!stated.aperture_m) stated.aperture_m = scene.camera.recorded_lens->aperture_m;
    if (!scene.camera.lens) {
      stated.blades = scene.camera.recorded_lens->blades;
      stated.blade_rotation_deg = scene.camera.recorded_lens->blade_rotation_deg;
    }
  }
  if (!stated.IsComplete()) {
    lens.source_ = DefocusSource::kOff;
    return lens;
  }
  lens.lens_ = stated;
  return lens;
}

std::optional<compositor::ThinLens> FrameLens::Of(std::int64_t frame_index) const {
  if (source_ == DefocusSource::kOff) return std::nullopt;
  const std::vector<double>& focus = lens_.focus_dioptres;
  const auto last = static_cast<std::int64_t>(focus.size()) - 1;
  return compositor::ThinLens{
      *lens_.aperture_m,
      focus[static_cast<std::size_t>(std::clamp<std::int64_t>(frame_index, 0, last))],
      {lens_.blades, lens_.blade_rotation_deg * std::numbers::pi / 180.0}};
}

}  // namespace pleinair::session
