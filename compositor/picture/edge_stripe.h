#pragma once

#include <vector>

#include "base/vector.h"
#include "compositor/picture/marker_in_image.h"

namespace pleinair::compositor {

/// A pixel near an edge: distance across the edge, towards the white, and brightness: 0 in the
/// black, 1 in the white.
struct EdgePixel {
  double distance_px = 0.0, value = 0.0;
};

/// A strip one pixel wide across a side of the outer black square.
struct EdgeStripe {
  Vec2 on_marker;         ///< Where it crosses the side, marker coordinates, metres.
  Vec2 edge_px, outward;  ///< The same place in the image, and the direction to the white there.
  double reach_px = 0.0;  ///< Pixels lie within that distance from the edge.
  std::vector<EdgePixel> pixels;
};

/// How far a stripe reaches.
struct StripeReach {
  double share = 0.9;  ///< A share of the narrower one of black band and white margin.
  double largest_px = 14.0;
};

/// Reads the stripe across a side: 0 top, 1 left, 2 bottom, 3 right. `along`: −1 at one end of the
/// side, 1 at the other. Returns false where the edge is outside the image, too small, clipped,
/// or has too little contrast for paper and ink. Reuses the memory of `stripe`.
bool ReadEdgeStripe(const MarkerInImage& marker, int side, double along, const StripeReach& reach,
                    EdgeStripe* stripe);

}  // namespace pleinair::compositor
