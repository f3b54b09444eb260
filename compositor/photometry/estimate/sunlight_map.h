#pragma once

#include <vector>

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/photometry/estimate/light_cell.h"
#include "compositor/photometry/estimate/light_posterior.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// Maps how much of the sun unmodelled things such as trees let through, along the sun's rays.
///
/// A sample that the phantoms leave in the sun lies between the levels of shade and sun on its
/// plane, which the fit found on `cells`. That gives its share of the sun. In a cell that lies in
/// the open sun, darker samples are joints and spots of the material: the share is 1. Otherwise the
/// share counts by the probability of shade. `to_sun` is a unit vector in marker coordinates.
SunTransmittanceMap MapSunlight(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                const std::vector<LightCell>& cells,
                                const LightPosterior& posterior, Vec3 to_sun);

}  // namespace pleinair::compositor
