#pragma once

#include "base/units.h"

namespace pleinair::sky {

/// How clear the sky is.
enum class SkyCondition { kClear, kHazy, kPartlyCloudy, kOvercast };

/// Illuminance on a surface facing the sun, and horizontal illuminance of the sky.
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
/// m = 1 / sin a above 10° and RelativeAirMass() below 6°, with a blend between, because 1 / sin a
/// diverges at the horizon. The sun's part decreases to zero as its disc sets; the sky's part
/// follows TwilightShare().
///
/// IES has no values for haze: kHazy has those of kClear.
StandardIlluminance ComputeStandardIlluminance(SkyCondition condition, Radians apparent_elevation,
                                               double distance_au);

}  // namespace pleinair::sky
