#pragma once

#include <cstdint>

#include "compositor/light/phantom_rays.h"
#include "compositor/light/sampling.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// Side of the phantoms' shadow on which a surface sample lies. kNeither: so near to the shadow's
/// edge that both sides mix in it.
enum class ShadowSide : std::uint8_t { kLit, kShaded, kNeither };

/// Finds the side; an edge is as wide as the sun's disc and 1.5 pixels of blur make it. `to_sun`:
/// its normal points to the sun's centre.
ShadowSide ShadowSideOf(const PhantomRays& phantoms, const SurfaceSample& sample,
                        const TangentFrame& to_sun);

}  // namespace pleinair::compositor
