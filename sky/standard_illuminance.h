#pragma once

#include "base/units.h"

namespace pleinair::sky {

/// How clear the sky is; decides the default turbidity and the sun's and sky's illuminance.
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
/// IES has no figure for haze and knows no turbidity. Clear and hazy skies of another turbidity
/// than the clear sky's default follow from the clear figures: the sun's is multiplied by the
/// ratio of LuminousTransmittance(); of the light that the beam loses (or wins), 0.756 = 0.9 · 0.84
/// goes to the sky: share scattered and not absorbed, and share of that which goes forward (Iqbal
/// 1983, model C).
StandardIlluminance ComputeStandardIlluminance(SkyCondition condition, double turbidity,
                                               Radians apparent_elevation, double distance_au);

/// 2.5 for a clear sky, 4 for a hazy one (diffuse share 0.39 at 30°), 3 between the clouds of a
/// partly cloudy one. (Preetham et al. 1999, Fig. 3: 2 very clear, 3 clear, 6 hazy to the eye.)
double DefaultTurbidity(SkyCondition condition);

}  // namespace pleinair::sky
