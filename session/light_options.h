#pragma once

#include <filesystem>

#include "compositor/photometry/light_overrides.h"
#include "scene/scene_description.h"

namespace pleinair::session {

/// What a user says of the light and of the camera's picture, of a recording or live.
struct LightOptions {
  compositor::LightOverrides overrides;
  bool match_look = true;                 ///< Drawn pixels get the frames' blur and grain.
  bool hands_in_front = false;            ///< What covers the marker is before the virtual objects.
  std::filesystem::path camera_response;  ///< Overrides the scene's; empty: as the scene says.
  std::filesystem::path cache;            ///< Folder for daylight coefficients; empty: without.
  int sky_division = 1;       ///< Of Tregenza's patches: compositor::CoefficientOptions.
  double convergence = 0.01;  ///< The same.
};

/// A scene with the heading and the camera's response that the user gives.
scene::SceneDescription WithGiven(const scene::SceneDescription& scene,
                                  const LightOptions& options);

}  // namespace pleinair::session
