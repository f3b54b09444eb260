#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// Marker numbers as the command line gives them, "17" or "0-49", in their order. Errors (input):
/// anything else, or a number outside 0…4095.
Result<std::vector<int>> ParseMarkerNumbers(const std::vector<std::string>& words);

}  // namespace pleinair::app
