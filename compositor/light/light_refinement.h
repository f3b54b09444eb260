#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "compositor/light/ray_scene.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// The surface of a mesh of the ray scene.
struct SurfaceOfRays {
  std::uint32_t surface = 0;  ///< Index into the surfaces.
  bool closed = false;
};

/// Result of RefineForLight() for one surface.
struct LightPlaces {
  double fine_m = 0.0;  ///< Length of fine edges: 1/64 of the object, at most `max_edge_m`; or 0.
  std::size_t in_file = 0;  ///< Vertices before those that were added for the light.
};

/// Splits edges of virtual objects where the light changes along them, so that light stored at
/// vertices does not depend on the mesh. The shape does not change.
///
/// Rays estimate the openness at the ends and the middle of an edge. Openness is the share of the
/// light from a uniform surrounding that arrives, with surfaces reflecting a fraction. The edge is
/// split if the middle differs from the mean of the ends by more than a threshold. It is also split
/// if only some of the three points lie inside a body. The threshold grows as edges get shorter
/// (docs/method/light.md, Eq. (4)). Edges at the same place are split together, whatever their
/// meshes and normals.
///
/// `surfaces`: those of the ray scene, not yet refined. New vertices follow the old ones.
/// `max_edge_m`: longest edge that is fine for an object of any size. Returns one entry per
/// surface; those of phantoms are zero.
std::vector<LightPlaces> RefineForLight(const RayScene& rays,
                                        const std::vector<SurfaceOfRays>& surfaces_of_rays,
                                        double max_edge_m, int threads,
                                        std::vector<SurfaceMesh>* surfaces);

}  // namespace pleinair::compositor
