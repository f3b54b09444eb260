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

}  // namespace pleinair::session
