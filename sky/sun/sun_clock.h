#pragma once

#include "base/units.h"
#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::sky {

/// The sun's local hour angle, −π…π: how far it has turned past the observer's meridian, westwards
/// positive. 0 at noon (upper transit), ±π at midnight (lower transit); it grows by 15° an hour at
/// every latitude, the poles included, where the longitude says which meridian is meant.
Radians HourAngle(const Observer& observer, UtcTime time, SunModel model = SunModel::kPrecise);

/// Equation of time in seconds: apparent minus mean solar time, what a sundial is ahead of a clock
/// that shows mean time (positive in October and November, as the almanacs have it). The same
/// everywhere on Earth. `ut1_minus_utc_s` as in Observer; it cancels but for its own sun's motion.
double EquationOfTimeSeconds(UtcTime time, double ut1_minus_utc_s = 0.0,
                             SunModel model = SunModel::kPrecise);

}  // namespace pleinair::sky
