#pragma once

#include <algorithm>
#include <cmath>

#include "base/vector.h"

namespace pleinair::sky {

/// The sun's direction, or for a sun below the horizon the point of the horizon above it. At the
/// nadir, where that is undefined, north.
inline Vec3 LiftedToHorizon(Vec3 to_sun) {
  if (to_sun.z >= 0.0) return to_sun;
  const double horizontal = std::hypot(to_sun.x, to_sun.y);
  if (horizontal == 0.0) return {0.0, 1.0, 0.0};
  return {to_sun.x / horizontal, to_sun.y / horizontal, 0.0};
}

/// Angle between unit vectors, radians. Computed from the chord: unlike acos it stays accurate near
/// 0.
inline double AngleBetween(Vec3 a, Vec3 b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * Norm(a - b)));
}

}  // namespace pleinair::sky
