#pragma once
// Internal: shared by the .cc files of this module; not installed.

#include <cstdint>

namespace pleinair::tracker {

/// Three consecutive rows of three adjacent layers: rows[layer][row]; the middle one is rows[1][1].
struct ResponseNeighbourhood {
  const float* rows[3][3];
};

/// Finds the indices i in begin..end - 1 at which the middle row is above `threshold` and the
/// maximum of its 3 x 3 x 3 neighbourhood (Bay et al. 2008, section 3.4); writes them to `maxima`
/// and returns their number. Of equal neighbours the first in (layer, row, i) wins, so a maximum
/// between two samples is found exactly once. Rows must be readable from begin - 1 to end + 64;
/// `maxima` must have room for end - begin + 64.
int FindResponseMaxima(const ResponseNeighbourhood& neighbourhood, int begin, int end,
                       float threshold, std::int32_t* maxima);

}  // namespace pleinair::tracker
