#pragma once

#include "base/units.h"
#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::sky {

/// Local hour angle of the sun, −π…π: its rotation past the observer's meridian, westwards
/// positive. 0 at noon (upper transit), ±π at midnight (lower transit). It grows by 15° per hour at
/// every latitude; at the poles the longitude defines the meridian.
Radians HourAngle(const Observer& observer, UtcTime time, SunModel model = SunModel::kPrecise);

/// Equation of time in seconds: apparent minus mean solar time (positive in October and November,
/// as in the almanacs). The same everywhere on Earth. `ut1_minus_utc_s` as in Observer; it cancels
/// except for the sun's own motion.
double EquationOfTimeSeconds(UtcTime time, double ut1_minus_utc_s = 0.0,
                             SunModel model = SunModel::kPrecise);

}  // namespace pleinair::sky
