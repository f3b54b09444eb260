#pragma once

#include "base/units.h"

namespace pleinair::sky {

/// Share of the horizon-sun's skylight that is left when the sun stands below the horizon: 1 at 0°,
/// 0.004 at −6°, about 1e-6 at −18° and lower. Interpolated in the logarithm of the clear sky's
/// illuminance in Seidelmann (ed.) 1992, "Explanatory Supplement to the Astronomical Almanac",
/// Table 8.2.
double TwilightShare(Radians apparent_elevation);

/// The sun whose twilight a physically based sky computes in place of the real one, and the share
/// of its light that is left. Below −9° light has been scattered several times over hundreds of
/// kilometres, which plane layers (sky/atmosphere/scattered_light.h) do not know: there the sky
/// keeps the pattern and color of −9°, and its light falls as TwilightShare() to nothing at −18°.
struct ComputedTwilight {
  double sun_elevation = 0.0;  ///< Radians.
  double share = 1.0;
};
ComputedTwilight TwilightToCompute(double sun_elevation);

}  // namespace pleinair::sky
