#pragma once

#include <string>

#include "app/accuracy/accuracy_json.h"

namespace pleinair::app {

/// What the composed pictures of recordings are worth: a table with intervals, and of the worst key
/// frames the truth, ours and the difference; nothing without recordings that have true pictures.
std::string LightSection(const AccuracyReport& report);

}  // namespace pleinair::app
