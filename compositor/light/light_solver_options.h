#pragma once

#include <cstddef>

namespace pleinair::compositor {

/// How finely and with how many rays the light among surfaces is computed.
struct LightSolverOptions {
  int rays_per_vertex = 256;   ///< Cosine-weighted, stratified; lowered for huge scenes.
  int bounces = 2;             ///< Diffuse reflections followed beyond the sky's direct light.
  double near_edge_m = 0.04;   ///< Longest edge of a triangle close to a virtual object.
  double growth_per_m = 0.25;  ///< How much longer edges may be per metre of distance.
  /// Where light is gathered, at most: in scenes of more vertices than that, those of fine surfaces
  /// share it by patches, and between patches it is interpolated (surface_patches.h).
  std::size_t max_patches = kDefaultPatches;
  int threads = 0;  ///< 0: as many as there are processors.

  static constexpr std::size_t kDefaultPatches = 100'000;
};

}  // namespace pleinair::compositor
