#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/output/light_csv.h"
#include "base/error.h"

namespace pleinair::app {

/// Parses what LightCsv() writes. `name`: of the file, for messages. Other columns are ignored.
/// Errors (input), with the line: a column is missing; a value is no number, not finite or
/// negative; an unknown source; times that do not rise.
Result<std::vector<LightRow>> ParseLightCsv(std::string_view text, const std::string& name);

}  // namespace pleinair::app
