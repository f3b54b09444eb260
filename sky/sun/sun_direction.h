#pragma once

#include <algorithm>
#include <cmath>

#include "base/vector.h"

namespace pleinair::sky {

/// The sun, or the point of the horizon above it; at the nadir north, as good as any.
inline Vec3 LiftedToHorizon(Vec3 to_sun) {
  if (to_sun.z >= 0.0) return to_sun;
  const double horizontal = std::hypot(to_sun.x, to_sun.y);
  if (horizontal == 0.0) return {0.0, 1.0, 0.0};
  return {to_sun.x / horizontal, to_sun.y / horizontal, 0.0};
}

/// Between unit vectors, radians. From the chord, which unlike acos keeps its digits near 0.
inline double AngleBetween(Vec3 a, Vec3 b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * Norm(a - b)));
}

}  // namespace pleinair::sky
