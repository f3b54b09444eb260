#pragma once

#include <vector>

#include "base/error.h"
#include "scene/drape_description.h"
#include "scene/toml_table.h"

namespace pleinair::scene {

/// Reads the tables [[drape]] of a scene; paths as in the file. Errors name line and key: unknown
/// keys and words, values out of range, keys that exclude each other, more than kMaxDrapes tables.
Result<std::vector<DrapeDescription>> ReadDrapes(const TomlTable& scene);

}  // namespace pleinair::scene
