#pragma once

#include <string>
#include <vector>

#include "content/georeference/map_transform.h"

namespace pleinair::app {

/// What may put map content in a wrong place, one sentence each, by how it was transformed.
std::vector<std::string> TransformWarnings(const content::TransformFacts& facts);

}  // namespace pleinair::app
