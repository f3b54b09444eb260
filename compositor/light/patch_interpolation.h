#pragma once

#include <vector>

#include "compositor/light/surface_patches.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// Says whose light each vertex of a divided surface gets, and how much of it: fills in `shares`
/// and `interpolation_ends`. `widths_m`: of patches as they are meant to be, by vertex.
void ComputeInterpolationWeights(const SurfaceMesh& mesh, const std::vector<double>& widths_m,
                                 int threads, SurfacePatches* patches);

}  // namespace pleinair::compositor
