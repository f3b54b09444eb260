#pragma once

#include "base/vector.h"
#include "compositor/light_solver.h"
#include "compositor/surface_samples.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// How much brighter one plane of a surface is than another of the same material, the top of a box
/// than its side, say, beyond what the light of `day` explains, its sun as the phantoms leave it:
/// logarithmic, of the pair that differs most; 0 where no surface shows two planes. Whatever casts
/// shadows lights planes by how they face it, wherever its shadows fall.
double FindPlaneContrast(const LightSolver& solver, const SurfaceSamples& samples,
                         const sky::SkyModel& day, const Mat3& marker_from_world);

}  // namespace pleinair::compositor
