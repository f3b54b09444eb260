#include "sky/sun/refraction.h"

#include <algorithm>
#include <cmath>

namespace pleinair::sky {
namespace {

constexpr double kSetElevationDeg = -0.8333;  // Upper limb on the horizon: 34′ + 16′ (USNO).
constexpr double kFadedElevationDeg = -3.0;

}  // namespace

Radians Refraction(Radians airless_elevation, double pressure_mbar, double temperature_c) {
  const double elevation_deg = ToDegrees(airless_elevation);
  if (elevation_deg <= kFadedElevationDeg) return Radians(0.0);
  const double e = std::max(elevation_deg, kSetElevationDeg);
  const double argument_rad = (e + 10.3 / (e + 5.11)) * kRadiansPerDegree;
  // Slightly negative (−0.08″) at the zenith, where the fit passes its own zero.
  const double minutes = std::max(0.0, 1.02 / std::tan(argument_rad));
  const double air = pressure_mbar / 1010.0 * 283.0 / (273.0 + temperature_c);
  double fade = 1.0;
  if (elevation_deg < kSetElevationDeg) {
    const double t = (elevation_deg - kFadedElevationDeg) / (kSetElevationDeg - kFadedElevationDeg);
    fade = t * t * (3.0 - 2.0 * t);
  }
  return FromDegrees(minutes / 60.0 * air * fade);
}

}  // namespace pleinair::sky
