#pragma once

#include "base/units.h"

namespace pleinair::sky {

/// Skylight with the sun below the horizon, relative to that with the sun on the horizon: 1 at 0°,
/// 0.004 at −6°, about 1e-6 at −18° and lower. Interpolates the logarithm of the clear sky's
/// illuminance in Seidelmann (ed.) 1992, "Explanatory Supplement to the Astronomical Almanac",
/// Table 8.2.
double TwilightShare(Radians apparent_elevation);

/// The sun elevation for which a physically based sky computes twilight, and the factor on its
/// light. Below −9° most light has been scattered several times over hundreds of kilometres, which
/// plane layers (sky/atmosphere/scattered_light.h) do not model. There the sky keeps the pattern
/// and color of −9°, and its light decreases with TwilightShare() to nothing at −18°.
struct ComputedTwilight {
  double sun_elevation = 0.0;  ///< Radians.
  double share = 1.0;
};
ComputedTwilight TwilightToCompute(double sun_elevation);

}  // namespace pleinair::sky
