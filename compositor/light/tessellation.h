#pragma once

#include <cstddef>
#include <vector>

#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

struct TessellationOptions {
  double near_edge_m = 0.04;   ///< Longest edge at a virtual object.
  double growth_per_m = 0.25;  ///< How much longer edges may be per metre of distance from one.
  /// Of all surfaces; where they do not fit, edges are no shorter at contacts, then grow.
  std::size_t max_vertices = 200'000;
};

/// Splits triangles until no edge is longer than the options allow where it lies, so that light
/// stored at vertices can be interpolated; where phantoms meet (contact_lines.h) edges are a third
/// as long, but not shorter than `near_edge_m`. Whether an edge is split depends on its two ends
/// and on what the whole scene has (objects, contacts), not on the triangle it belongs to:
/// neighbours split a shared edge at the same point, also across surfaces, and no gaps open.
/// Distances are taken to the boxes around the virtual objects' surfaces, or to the marker where
/// there are none. Surfaces that are fine enough already stay as they are.
void Tessellate(const TessellationOptions& options, std::vector<SurfaceMesh>* surfaces);

}  // namespace pleinair::compositor
