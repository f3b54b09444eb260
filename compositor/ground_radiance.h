#pragma once

#include <vector>

#include "base/vector.h"
#include "compositor/light_solver.h"

namespace pleinair::compositor {

/// Mean radiance that the phantoms send upwards, or all there is in a scene without any, for
/// reflections below the horizon. `to_sun` in marker coordinates.
LinearRgb MeanGroundRadiance(const std::vector<LitMesh>& lit, const std::vector<PlacedModel>& scene,
                             LinearRgb sun_normal, Vec3 to_sun);

}  // namespace pleinair::compositor
