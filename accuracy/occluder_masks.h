#pragma once

#include <string>

#include "accuracy/occluders.h"
#include "accuracy/random.h"

namespace pleinair::accuracy {

/// Signed distances (edges, negative inside) to the outline of an occluder that is a hand or
/// fingers; for others 0 inside and 1 outside.
struct OccluderMask {
  Image<float> cover;     ///< 0 or 1.
  Image<float> distance;  ///< Empty for flat occluders.
};

/// The mask of a pattern that covers `share` of border or content.
OccluderMask MakeOccluderMask(const std::string& pattern, double share, RandomStream* random);

CoveredShares SharesOf(const Image<float>& cover);

/// Whether texel (x, y) lies in the marker's content; in the marker's square.
bool IsContent(int x, int y);
bool IsMarker(int x, int y);

}  // namespace pleinair::accuracy
