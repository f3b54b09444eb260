#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/project/new_scene.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "scene/trajectory_description.h"

namespace pleinair::app {

/// The commented scene.toml of a new project in `folder`. Every value states where it is known
/// from. Error (input): a name that is not UTF-8.
Result<std::string> NewSceneToml(const NewScene& scene, const std::filesystem::path& folder);

/// The table [trajectory] of a new scene.toml in `folder`. Error (input): a name that is not UTF-8.
Result<std::string> NewTrajectoryToml(const scene::TrajectoryDescription& trajectory,
                                      const std::filesystem::path& folder);

/// The recording.json of a new project: the film, relative to `folder`, and the lens. Error
/// (input): a name that is not UTF-8.
Result<std::string> NewRecordingJson(const std::filesystem::path& film, const KnownLens& lens,
                                     const std::filesystem::path& folder);

/// The value of "program" in a recording.json that NewRecordingJson() made.
inline constexpr std::string_view kNewProgram = "pleinair new";

}  // namespace pleinair::app
