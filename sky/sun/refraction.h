#pragma once

#include "base/units.h"

namespace pleinair::sky {

/// How much the air lifts a body of this airless elevation.
///
/// Sæmundsson 1986, Sky & Telescope 72, 70 (in Meeus, Astronomical Algorithms, Eq. 16.4):
///   R = 1.02′ / tan(e + 10.3 / (e + 5.11)) · P / 1010 mbar · 283 K / (273 K + T),  e in degrees.
/// It holds down to the horizon. Below e = −0.8333°, where the disc has set, nobody sees the body:
/// the last value fades out smoothly to nothing at −3°.
Radians Refraction(Radians airless_elevation, double pressure_mbar, double temperature_c);

}  // namespace pleinair::sky
