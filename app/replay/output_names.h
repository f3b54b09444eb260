#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// Folder names for the outputs of several recordings: the name of a recording's folder, or of its
/// film without the ending. Errors (input): two recordings of one name; one without a name.
Result<std::vector<std::string>> OutputNames(const std::vector<std::string>& recordings);

}  // namespace pleinair::app
