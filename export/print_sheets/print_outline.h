#pragma once

#include <vector>

#include "tracker/marker_pattern.h"

namespace pleinair::exports {

/// A corner between modules, in modules: 0,0 is the marker's top-left corner, x right, y down.
struct ModuleCorner {
  int x = 0, y = 0;
  bool operator==(const ModuleCorner&) const = default;
};

/// Traces the black areas of a marker as closed loops along module edges, for the even-odd fill
/// rule. Every loop turns at each of its corners, and no edge lies between two black modules. A
/// renderer with antialiasing therefore shows no lines inside an area. Where black modules touch
/// only at a corner, each has its own loop.
std::vector<std::vector<ModuleCorner>> TraceBlackOutlines(const tracker::MarkerPattern& print);

}  // namespace pleinair::exports
