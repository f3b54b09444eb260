#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// Parses marker numbers of the command line, "17" or "0-49", in order. Errors (input): other text,
/// or a number outside 0…4095.
Result<std::vector<int>> ParseMarkerNumbers(const std::vector<std::string>& words);

}  // namespace pleinair::app
