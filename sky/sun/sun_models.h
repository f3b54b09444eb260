#pragma once

#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::sky::internal {

/// Result of a model of the sun's motion: topocentric, without refraction.
struct AirlessSun {
  double azimuth_rad = 0.0;  ///< Clockwise from true north, 0…2π.
  double elevation_rad = 0.0;
  double distance_au = 1.0;
};

AirlessSun PreciseSun(const Observer& observer, UtcTime time);
AirlessSun PaperSun(const Observer& observer, UtcTime time);

}  // namespace pleinair::sky::internal
