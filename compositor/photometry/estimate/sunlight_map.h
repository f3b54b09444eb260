#pragma once

#include <vector>

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/photometry/estimate/light_cell.h"
#include "compositor/photometry/estimate/light_posterior.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// Maps the sun transmittance of unmodelled geometry such as trees, along the sun's rays.
///
/// The fit on `cells` found two levels of brightness on each plane: in shadow and in the sun. A
/// sample that the phantoms leave sunlit lies between them. That gives its share of the sun. In a
/// cell in direct sunlight, darker samples are joints and spots of the material: the share is 1.
/// Otherwise the share counts by the probability of shadow. `to_sun` is a unit vector in marker
/// coordinates.
SunTransmittanceMap MapSunlight(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                const std::vector<LightCell>& cells,
                                const LightPosterior& posterior, Vec3 to_sun);

}  // namespace pleinair::compositor
