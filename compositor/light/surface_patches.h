#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compositor/light/light_refinement.h"
#include "compositor/light/tessellation.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// Groups of neighbouring vertices with similar normals that gather light together. They serve
/// surfaces with far more vertices than the light needs. A patch gathers the mean over its area;
/// each vertex interpolates the patches around it.
///
/// The light at a vertex is a moving-least-squares fit of the means, linear in position and normal.
/// Light that is linear in either is reproduced exactly, and no patch edges are visible. Method:
/// Levin 1998, "The approximation power of moving least-squares", Mathematics of Computation 67.
struct SurfacePatches {
  /// Weight of a patch's light at a vertex. The weights of a vertex add up to 1; single weights may
  /// be slightly negative.
  struct InterpolationWeight {
    std::uint32_t patch = 0;
    float weight = 0.0F;
  };

  std::uint32_t count = 0;
  std::vector<std::uint32_t> patch_of;  ///< One entry per vertex.
  /// Vertices grouped by patch; those of patch p start at member_ends[p − 1], or at 0 for the
  /// first.
  std::vector<std::uint32_t> members, member_ends;
  std::vector<std::array<std::uint32_t, 2>> links;         ///< Neighbours, each pair once.
  std::vector<InterpolationWeight> interpolation_weights;  ///< By vertex, as members by patch.
  std::vector<std::uint32_t> interpolation_ends;

  /// Computes the light of all vertices from that of the patches; never negative.
  std::vector<std::array<float, 3>> Interpolate(std::span<const std::array<float, 3>> light) const;
};

/// Divides those virtual objects whose files have at least twice as many vertices as their light
/// needs: into patches as wide as a fine edge. Vertices that were added for the light stay patches
/// of their own; an object with many of them is not divided. The result has one entry per surface,
/// empty as in DividedIntoPatches().
std::vector<SurfacePatches> DividedWhereDense(const std::vector<SurfaceMesh>& surfaces,
                                              const std::vector<LightPlaces>& light_places,
                                              int threads);

/// Number of patches on all sides of the surfaces.
std::size_t PatchCount(const std::vector<SurfaceMesh>& surfaces,
                       const std::vector<SurfacePatches>& divided);

/// Divides surfaces into at most `max_patches` in total, but at least one each. An open surface
/// counts twice, for its two sides. Patches are equally wide, except that they grow with the
/// distance from virtual objects as the tessellation's edges do. A patch is connected unless the
/// surfaces have too many separate pieces, such as leaves. The result has one entry per surface; in
/// an empty one (count 0), each vertex is its own patch.
std::vector<SurfacePatches> DividedIntoPatches(const std::vector<SurfaceMesh>& surfaces,
                                               const TessellationOptions& spacing,
                                               std::size_t max_patches, int threads);

}  // namespace pleinair::compositor
