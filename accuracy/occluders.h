#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/scene.h"
#include "base/image.h"

namespace pleinair::accuracy {

/// Patterns that cover the border and leave the content clear (but "hand", which lies over both):
/// corner1, corners2, corners4, side1, sides2opp, sides2adj, fingers, blobs, hand.
const std::vector<std::string>& BorderPatterns();
/// Patterns that are measured by the content: cblobs, cbar, cfinger (crosses the border), chand.
const std::vector<std::string>& ContentPatterns();
/// The largest share of the border (or content) that a pattern can cover.
double MaxShare(const std::string& pattern);

/// Shares of a marker that are covered, of the border, the content and all of it.
struct CoveredShares {
  double border = 0.0, content = 0.0, total = 0.0;
};

/// What lies on a marker, drawn in its plane: 240 texels an edge, from three quarters of an edge
/// left of (above) the marker's square to as much right of it.
struct Occluder {
  static constexpr double kFirst = -0.75, kLast = 1.75;  ///< Edges; the square spans 0…1.
  static constexpr int kTexelsPerEdge = 240;
  static constexpr int kTexels = 600;

  Image<float> light;   ///< What it reflects, linear.
  Image<float> cover;   ///< 0 or 1.
  Image<float> shadow;  ///< Share of light that it takes from what lies beside it.
  CoveredShares shares;
  double extent = 1.0;  ///< Half edges from the marker's middle that it and its shadow reach.
};

/// Deterministic: `spec` and `seed` say all. The covered share is as near to the wanted one as the
/// pattern comes.
Occluder MakeOccluder(const OccluderSpec& spec, std::uint64_t seed);

}  // namespace pleinair::accuracy
