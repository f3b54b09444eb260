#pragma once

#include <optional>

#include "base/error.h"
#include "scene/lens_description.h"
#include "scene/toml_table.h"

namespace pleinair::scene {

/// Reads [lens]; nothing if the scene has none. Errors (input): unknown keys, and those of
/// CompleteLens().
Result<std::optional<LensDescription>> ReadLensTable(const TomlTable& scene);

}  // namespace pleinair::scene
