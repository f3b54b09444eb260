#pragma once

#include <string>

#include "app/flow/flow_lines.h"

namespace pleinair::app {

/// A plan of the lines as SVG: x right, y up, colored by speed, with the range of speeds and a bar
/// of length.
std::string FlowPlan(const FlowLines& lines);

}  // namespace pleinair::app
