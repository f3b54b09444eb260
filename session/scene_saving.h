#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/scene_description.h"
#include "session/scene_edit.h"

namespace pleinair::session {

/// Returns the text of a scene.toml with the changes from one edit to another. Only changed values
/// differ (scene/toml_text.h). Saved are location, heading, haze, clouds, and the placement of
/// objects and boxes. Also the corners of walls, and the height of the marker above the ground.
///
/// Lengths are written to 0.1 mm, angles to 0.001°, locations to 1e-7°, scales to six digits. Cloud
/// cover becomes the nearest word for the sky. The hour, drawing options and locked exposures are
/// no part of a scene and are not written. `scene`: as read from the text, with its file's name for
/// messages. Errors: the text is no scene; it has other objects than the scene; a value is out of
/// the range of a scene.
Result<std::string> WithSavedEdit(std::string_view text, const scene::SceneDescription& scene,
                                  const SceneEdit& from, const SceneEdit& to);

/// True if two edits differ in what WithSavedEdit() writes.
bool ChangesScene(const SceneEdit& from, const SceneEdit& to);

}  // namespace pleinair::session
