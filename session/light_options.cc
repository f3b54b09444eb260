#include "session/light_options.h"

namespace pleinair::session {

const char* NameOf(LightChangeMode mode) {
  switch (mode) {
    case LightChangeMode::kFollow:
      return "follow";
    case LightChangeMode::kHold:
      return "hold";
    case LightChangeMode::kStated:
      return "stated";
  }
  return "follow";
}

scene::SceneDescription WithGiven(const scene::SceneDescription& scene,
                                  const LightOptions& options) {
  scene::SceneDescription given = scene;
  if (!options.camera_response.empty()) given.camera.response = options.camera_response;
  if (options.overrides.heading_deg) {
    given.marker.heading = FromDegrees(*options.overrides.heading_deg);
  }
  return given;
}

std::optional<scene::LensDescription> StatedLens(const scene::SceneDescription& scene,
                                                 const LightOptions& options) {
  const std::optional<scene::LensDescription>& recorded = scene.camera.recorded_lens;
  std::optional<scene::LensDescription> lens = scene.camera.lens;
  if (!lens) {
    lens = recorded;
  } else if (recorded) {
    if (lens->focus_dioptres.empty()) lens->focus_dioptres = recorded->focus_dioptres;
    if (!lens->aperture_m) lens->aperture_m = recorded->aperture_m;
    if (lens->exposure_s.empty()) lens->exposure_s = recorded->exposure_s;
  }
  const DefocusOptions& defocus = options.defocus;
  const std::optional<double>& exposure_s = options.motion_blur.exposure_s;
  if (!lens && (defocus.focus_dioptres || defocus.aperture_m || exposure_s)) lens.emplace();
  if (defocus.focus_dioptres) lens->focus_dioptres = {*defocus.focus_dioptres};
  if (defocus.aperture_m) lens->aperture_m = defocus.aperture_m;
  if (exposure_s) lens->exposure_s = {*exposure_s};
  return lens;
}

}  // namespace pleinair::session
