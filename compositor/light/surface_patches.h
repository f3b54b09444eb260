#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compositor/light/tessellation.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// Pieces of one surface that gather light as one, for surfaces of far more vertices than light
/// needs: neighbouring vertices whose normals point about the same way. What they gather is the
/// mean over the piece; each vertex takes its light from the pieces around it.
///
/// The light at a vertex is a moving least squares fit of the means, linear in place and normal
/// (Levin 1998, "The approximation power of moving least-squares", Mathematics of Computation 67):
/// light that changes linearly with either comes out exact, and no edge of a piece shows.
struct SurfacePatches {
  /// A share of a patch's light in a vertex'. Shares of a vertex add up to 1; single ones may be
  /// slightly negative.
  struct InterpolationWeight {
    std::uint32_t patch = 0;
    float weight = 0.0F;
  };

  std::uint32_t count = 0;
  std::vector<std::uint32_t> patch_of;  ///< Of each vertex.
  /// Vertices by patch, those of patch p from member_ends[p − 1] (0 for the first) on.
  std::vector<std::uint32_t> members, member_ends;
  std::vector<std::array<std::uint32_t, 2>> links;         ///< Neighbours, each pair once.
  std::vector<InterpolationWeight> interpolation_weights;  ///< By vertex, as members are by patch.
  std::vector<std::uint32_t> interpolation_ends;

  /// Light of all vertices from that of the patches; never negative.
  std::vector<std::array<float, 3>> Interpolate(std::span<const std::array<float, 3>> light) const;
};

/// Divides surfaces into at most `max_patches` altogether, an open surface counted twice for its
/// two sides; but each has one at least. Patches are as wide everywhere as budgeted, except that
/// they grow with the distance from virtual objects as tessellation's edges do. Those of one patch
/// hang together, unless there are too many loose pieces for that (leaves). One result a surface;
/// an empty one (count 0): each vertex is its own patch.
std::vector<SurfacePatches> DividedIntoPatches(const std::vector<SurfaceMesh>& surfaces,
                                               const TessellationOptions& spacing,
                                               std::size_t max_patches, int threads);

}  // namespace pleinair::compositor
