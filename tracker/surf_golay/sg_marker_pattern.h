#pragma once

#include <cstdint>

#include "tracker/marker_pattern.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {

/// What the marker of an S-G marker looks like, quiet zone included. `number` is 0…4095.
MarkerPattern SgMarkerPattern(int number);

/// The same for a printed word: bit i (from the least significant) is code cell i, 1 white. Another
/// `border` than that of this version is for tools that look for one.
MarkerPattern SgMarkerPatternOfWord(std::uint32_t word, const sg::Border& border = sg::kBorder);

}  // namespace pleinair::tracker
