#pragma once

#include <optional>

#include "base/error.h"
#include "scene/toml_table.h"
#include "scene/trajectory_description.h"

namespace pleinair::scene {

/// Reads [trajectory]; nothing if the scene has none. Paths are relative to the scene's folder.
/// Errors (input): unknown keys, no file, values out of range.
Result<std::optional<TrajectoryDescription>> ReadTrajectoryTable(const TomlTable& scene);

}  // namespace pleinair::scene
