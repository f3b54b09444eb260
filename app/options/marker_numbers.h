#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// Parses the S-G numbers of --numbers: single ones and ranges, "17", "0-49". Errors (input): other
/// text, numbers above 4095.
Result<std::vector<int>> MarkerNumbersOf(const std::vector<std::string>& texts);

}  // namespace pleinair::app
