#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/project/film_look.h"
#include "base/error.h"
#include "base/image.h"
#include "scene/scene_description.h"

namespace pleinair::app {

/// One composed frame of a new project.
struct FirstPicture {
  RgbImage image;
  std::vector<std::string> warnings;  ///< As of a replay, one sentence each.
};

/// Composes one frame of a film as `pleinair replay --frame` does: its light is estimated from this
/// frame alone. Errors: those of Pipeline::Create() and of the passes; interrupted.
Result<FirstPicture> ComposeFirstPicture(const FilmLook& look, std::int64_t frame,
                                         const scene::SceneDescription& scene);

}  // namespace pleinair::app
