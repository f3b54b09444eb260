#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace pleinair::sky {

/// Angular radius of the sun's disc at 1 au: 959.63″ (IAU 1976's 6.96e5 km).
inline constexpr double kSolarRadiusAt1Au = 959.63 / 3600.0 * kRadiansPerDegree;

/// Share of the disc (as if uniformly bright) above a level horizon, for an apparent elevation of
/// its centre.
inline double DiscShareAboveHorizon(Radians apparent_elevation) {
  const double height = std::clamp(apparent_elevation.value() / kSolarRadiusAt1Au, -1.0, 1.0);
  return 0.5 + (height * std::sqrt(1.0 - height * height) + std::asin(height)) / std::numbers::pi;
}

/// Luminance of the disc at the angle `from_centre` from its centre, relative to its mean.
/// Eddington's linear law of limb darkening: I / I_centre = 1 − u (1 − µ), µ = √(1 − r²), with u =
/// 0.6 for green light (Cox 2000, "Allen's Astrophysical Quantities", §14.7); the mean is 1 − u/3.
/// Zero outside the disc.
inline double LimbDarkening(double from_centre_rad, double disc_radius_rad) {
  constexpr double kU = 0.6;
  const double r = from_centre_rad / disc_radius_rad;
  if (!(r < 1.0)) return 0.0;
  return (1.0 - kU * (1.0 - std::sqrt(1.0 - r * r))) / (1.0 - kU / 3.0);
}

}  // namespace pleinair::sky
