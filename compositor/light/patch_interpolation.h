#pragma once

#include <vector>

#include "compositor/light/surface_patches.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// Computes the interpolation weights of each vertex of a divided surface. It fills in
/// `interpolation_weights` and `interpolation_ends`. `widths_m`: nominal patch width at each
/// vertex.
void ComputeInterpolationWeights(const SurfaceMesh& mesh, const std::vector<double>& widths_m,
                                 int threads, SurfacePatches* patches);

}  // namespace pleinair::compositor
