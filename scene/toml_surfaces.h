#pragma once

#include <vector>

#include "base/error.h"
#include "scene/scene_description.h"
#include "scene/scene_facts.h"
#include "scene/toml_table.h"

namespace pleinair::scene {

/// Reads the models of a TOML scene: the tables under `key`, [[object]] or [[phantom]].
Result<std::vector<ModelReference>> ReadModels(const TomlTable& scene, const char* key);

/// Appends the real surfaces that the scene describes without a file, [[box]] and [[wall]].
Result<void> ReadDescribedSurfaces(const TomlTable& scene, std::vector<ModelReference>* phantoms);

/// Reads [ground], or `ground = false`: none is assumed.
Result<void> ReadGround(const TomlTable& scene, GroundFacts* facts);

}  // namespace pleinair::scene
