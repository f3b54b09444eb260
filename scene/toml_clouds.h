#pragma once

#include <vector>

#include "base/error.h"
#include "scene/toml_table.h"
#include "sky/clouds/cloud_layer.h"

namespace pleinair::scene {

/// Reads the tables [[cloud_layer]] of a scene. Errors name line and key: unknown keys and kinds,
/// values out of range (clouds::MakeCloudLayer()), more than clouds::kMaxCloudLayers tables.
Result<std::vector<clouds::CloudLayer>> ReadCloudLayers(const TomlTable& scene);

}  // namespace pleinair::scene
