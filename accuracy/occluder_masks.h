#pragma once

#include <string>

#include "accuracy/occluders.h"
#include "accuracy/random.h"

namespace pleinair::accuracy {

/// Signed distances (edges, negative inside) to an occluder's outline where it is a hand or
/// fingers; 0 and 1 (inside, outside) elsewhere.
struct OccluderMask {
  Image<float> cover;     ///< 0 or 1.
  Image<float> distance;  ///< Empty where the occluder is flat.
};

/// The mask of a pattern that covers `share` of the border or content.
OccluderMask MakeOccluderMask(const std::string& pattern, double share, RandomStream* random);

CoveredShares SharesOf(const Image<float>& cover);

/// Whether texel (x, y) lies in the marker's content; in the marker's square.
bool IsContent(int x, int y);
bool IsMarker(int x, int y);

}  // namespace pleinair::accuracy
