#pragma once

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace pleinair::sky {

/// Relative optical air mass: 1 at the zenith, 38 at the horizon. Kasten & Young 1989, "Revised
/// optical air mass tables and approximation formula", Applied Optics 28(22), Eq. (3):
///
///   m = 1 / (sin γ + 0.50572 (γ + 6.07995°)^−1.6364),   γ the apparent elevation.
///
/// Below −0.5°, where the sun's disc has set, it keeps its value at −0.5°.
inline double RelativeAirMass(Radians apparent_elevation) {
  const double elevation_deg = std::max(ToDegrees(apparent_elevation), -0.5);
  return 1.0 / (std::sin(elevation_deg * kRadiansPerDegree) +
                0.50572 * std::pow(elevation_deg + 6.07995, -1.6364));
}

}  // namespace pleinair::sky
