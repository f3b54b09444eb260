#pragma once

#include <cstddef>
#include <vector>

#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

struct TessellationOptions {
  double near_edge_m = 0.04;   ///< Longest edge at a virtual object.
  double growth_per_m = 0.25;  ///< Increase of that length per metre of distance from one.
  /// Max. total of all surfaces. If they exceed it, contacts get no shorter edges; then all edges
  /// grow.
  std::size_t max_vertices = 200'000;
};

/// Splits triangles until no edge exceeds the length that the options allow at its place. Light
/// stored at vertices can then be interpolated. At contact edges of phantoms (contact_edges.h) the
/// length is about a third, but not less than `near_edge_m`.
///
/// A split depends on the edge's two ends and on the whole scene (objects, contacts), not on its
/// triangle. Neighbours therefore split a shared edge at the same point, also across surfaces, and
/// no gaps open. Distances are measured to the bounding boxes of the virtual objects' surfaces, or
/// to the marker without objects. Surfaces that are fine enough remain unchanged.
void Tessellate(const TessellationOptions& options, std::vector<SurfaceMesh>* surfaces);

}  // namespace pleinair::compositor
