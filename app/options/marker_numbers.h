#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// The S-G numbers that --numbers names: single ones and ranges, "17", "0-49". Errors (input):
/// other words, numbers beyond 4095.
Result<std::vector<int>> MarkerNumbersOf(const std::vector<std::string>& texts);

}  // namespace pleinair::app
