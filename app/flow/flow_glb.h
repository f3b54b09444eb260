#pragma once

#include <string>

#include "app/flow/flow_lines.h"

namespace pleinair::app {

/// The lines as a binary glTF 2.0 file, y up: (x, y, z) becomes (x, z, −y). Vertices are relative
/// to the middle of the lines, which is the node's translation; colors state the speed.
std::string FlowGlb(const FlowLines& lines);

}  // namespace pleinair::app
