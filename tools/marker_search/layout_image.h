#pragma once

#include <string>

#include "tracker/marker_pattern.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::marker_search {

/// A marker as an SVG drawing, one unit per module.
std::string DrawSvg(const tracker::MarkerPattern& print);

/// A border as rows of the array in sg_layout.h.
std::string WriteRows(const tracker::sg::Border& border);

}  // namespace pleinair::marker_search
