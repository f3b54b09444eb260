#pragma once

#include <cstddef>

namespace pleinair::compositor {

/// Resolution and number of rays of the indirect illumination.
struct LightSolverOptions {
  int rays_per_vertex = 256;   ///< Cosine-weighted, stratified; fewer in huge scenes.
  int bounces = 2;             ///< Max. diffuse reflections after the sky's direct light.
  double near_edge_m = 0.04;   ///< Longest edge of a triangle close to a virtual object.
  double growth_per_m = 0.25;  ///< Increase of that length per metre of distance.
  /// Max. number of patches that gather light. If a scene has more vertices, the vertices of fine
  /// surfaces share patches. The light is interpolated between them (surface_patches.h).
  std::size_t max_patches = kDefaultPatches;
  /// Objects with at least twice as many vertices as their light needs share patches, too.
  bool share_dense = true;
  int threads = 0;  ///< 0: one per processor.

  static constexpr std::size_t kDefaultPatches = 100'000;
};

}  // namespace pleinair::compositor
