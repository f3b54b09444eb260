#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/scene.h"
#include "base/image.h"

namespace pleinair::accuracy {

/// Patterns that cover the border and leave the content free (except "hand", which lies over both):
/// corner1, corners2, corners4, side1, sides2opp, sides2adj, fingers, blobs, hand.
const std::vector<std::string>& BorderPatterns();
/// Patterns defined by their share of the content: cblobs, cbar, cfinger (crosses the border),
/// chand.
const std::vector<std::string>& ContentPatterns();
/// Maximum share of the border (or content) that a pattern can cover.
double MaxShare(const std::string& pattern);

/// Covered shares of the border, the content and the whole marker.
struct CoveredShares {
  double border = 0.0, content = 0.0, total = 0.0;
};

/// An occluder on a marker, rendered in the marker's plane: 240 texels per edge, from three
/// quarters of an edge left of (above) the marker's square to as much right of (below) it.
struct Occluder {
  static constexpr double kFirst = -0.75, kLast = 1.75;  ///< Edges; the square spans 0…1.
  static constexpr int kTexelsPerEdge = 240;
  static constexpr int kTexels = 600;

  Image<float> light;   ///< Reflected light, linear.
  Image<float> cover;   ///< 0 or 1.
  Image<float> shadow;  ///< Share of light that its shadow removes from the surface next to it.
  CoveredShares shares;
  double extent = 1.0;  ///< Extent of occluder and shadow from the marker's centre, half edges.
};

/// Deterministic for `spec` and `seed`. The covered share is as close to the requested one as the
/// pattern allows.
Occluder MakeOccluder(const OccluderSpec& spec, std::uint64_t seed);

}  // namespace pleinair::accuracy
