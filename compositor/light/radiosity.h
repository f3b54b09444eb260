#pragma once

#include <array>
#include <vector>

#include "base/vector.h"
#include "compositor/light/final_gather.h"
#include "compositor/light/patch_scene.h"

namespace pleinair::compositor {

/// Irradiance on every patch, lux. Index 0: with the virtual objects, 1: phantoms alone
/// (meaningless for patches of objects).
struct PatchLight {
  std::array<std::vector<std::array<float, 3>>, 2> irradiance;
  /// The part of it that is reflected sunlight; the rest comes from the sky.
  std::array<std::vector<std::array<float, 3>>, 2> reflected;
};

/// Computes the irradiance on every patch by `bounces` radiosity iterations of the gathered light
/// (docs/method/light.md, Eqs. (1) and (3)). From two iterations on, the remaining reflections on
/// virtual objects are extrapolated. Buried patches, such as the ground under a wall, take their
/// neighbours' values. Otherwise they would darken these neighbours. `sun_irradiance`: on a plane
/// that faces the sun, lux, linear Rec.709. `to_sun`: unit, marker coordinates. The result does not
/// depend on the number of threads.
PatchLight SolveRadiosity(const PatchScene& scene, const FinalGather& gathered,
                          const std::array<float, 3>& sun_irradiance, Vec3 to_sun, int bounces,
                          int threads);

}  // namespace pleinair::compositor
