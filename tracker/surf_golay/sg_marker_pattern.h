#pragma once

#include <cstdint>

#include "tracker/marker_pattern.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {

/// Bit pattern of an S-G marker, quiet zone included. `number` is 0…4095.
MarkerPattern SgMarkerPattern(int number);

/// Bit pattern of a printed word: bit i (from the least significant) is code cell i, 1 white. A
/// `border` other than this version's is for tools that optimise it.
MarkerPattern SgMarkerPatternOfWord(std::uint32_t word, const sg::Border& border = sg::kBorder);

}  // namespace pleinair::tracker
