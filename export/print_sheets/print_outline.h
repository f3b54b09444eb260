#pragma once

#include <vector>

#include "tracker/marker_pattern.h"

namespace pleinair::exports {

/// A corner between modules: 0,0 is the print's top-left corner, x right, y down, in modules.
struct ModuleCorner {
  int x = 0, y = 0;
  bool operator==(const ModuleCorner&) const = default;
};

/// The black areas of a print as closed loops along module edges, to be filled by the even-odd
/// rule. Every loop turns at each of its corners, and no edge lies between two black modules: a
/// renderer that smooths edges has nothing to show inside an area. Where black modules touch at a
/// corner only, each has its own loop.
std::vector<std::vector<ModuleCorner>> TraceBlackOutlines(const tracker::MarkerPattern& print);

}  // namespace pleinair::exports
