#pragma once

#include "base/units.h"

namespace pleinair::sky {

/// How clear the sky is.
enum class SkyCondition { kClear, kHazy, kPartlyCloudy, kOvercast };

/// What falls on a surface that faces the sun, and from the sky on level ground.
struct StandardIlluminance {
  Lux sun_normal;
  Lux sky_horizontal;
};

/// Illuminances of the Illuminating Engineering Society (IES RP-21, "Recommended practice for the
/// calculation of daylight availability", 1984), for a sun of apparent elevation a:
///
///   sun normal  127.5 klx (1/d²) e^(−c m)     c = 0.21 clear, 0.80 partly cloudy, none overcast
///   sky         0.8 + 15.5 √(sin a) klx clear, 0.3 + 45 sin a partly cloudy, 0.3 + 21 sin a
///   overcast
///
/// m = 1 / sin a above 10°, RelativeAirMass() below 6°, a blend between, where 1 / sin a fails. The
/// sun's share falls to nothing as its disc sinks below the horizon, the sky's with
/// TwilightShare().
///
/// IES has no figure for haze: kHazy has those of kClear.
StandardIlluminance ComputeStandardIlluminance(SkyCondition condition, Radians apparent_elevation,
                                               double distance_au);

}  // namespace pleinair::sky
