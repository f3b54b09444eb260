#pragma once

#include <vector>

#include "base/error.h"
#include "scene/leaf_description.h"
#include "scene/toml_table.h"

namespace pleinair::scene {

/// Reads the tables [[leaf]] of a scene. Paths of maps are resolved against the scene's folder.
/// Errors name line and key. They are unknown keys and models, values out of range, or spad beside
/// chlorophyll. Tables without materials, and stages without a date or out of order, are errors
/// too.
Result<std::vector<LeafDescription>> ReadLeaves(const TomlTable& scene);

}  // namespace pleinair::scene
