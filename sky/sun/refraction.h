#pragma once

#include "base/units.h"

namespace pleinair::sky {

/// Refraction: apparent minus airless elevation of a body.
///
/// Sæmundsson 1986, Sky & Telescope 72, 70 (in Meeus, Astronomical Algorithms, Eq. 16.4):
///   R = 1.02′ / tan(e + 10.3 / (e + 5.11)) · P / 1010 mbar · 283 K / (273 K + T),  e in degrees.
/// Valid down to the horizon. Below e = −0.8333°, where the disc has set, the last value fades
/// smoothly to zero at −3°.
Radians Refraction(Radians airless_elevation, double pressure_mbar, double temperature_c);

}  // namespace pleinair::sky
