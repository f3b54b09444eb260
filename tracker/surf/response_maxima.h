#pragma once
// Internal: between the .cc files of this module; not installed.

#include <cstdint>

namespace pleinair::tracker {

/// Three consecutive rows of three neighbouring layers: rows[layer][row], the middle one is
/// rows[1][1].
struct ResponseNeighbourhood {
  const float* rows[3][3];
};

/// Writes those i in begin..end - 1 at which the middle row is above `threshold` and the largest of
/// its 3 x 3 x 3 neighbourhood (Bay et al. 2008, section 3.4); returns how many. Of equal
/// neighbours the first in (layer, row, i) wins, so that a maximum between two samples is found
/// exactly once. Rows are readable from begin - 1 to end + 64; `maxima` has room for end - begin
/// + 64.
int FindResponseMaxima(const ResponseNeighbourhood& neighbourhood, int begin, int end,
                       float threshold, std::int32_t* maxima);

}  // namespace pleinair::tracker
