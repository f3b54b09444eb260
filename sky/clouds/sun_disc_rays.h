#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cmath>

#include "base/vector.h"
#include "sky/sun/solar_disc.h"

namespace pleinair::clouds {

inline constexpr int kSunDiscRays = 64;

/// Positions of equal area in the unit disc, on a sunflower's spiral (Vogel 1979).
inline Vec2 InUnitDisc(int i) {
  constexpr double kGoldenAngle = 2.399963229728653;
  const double radius = std::sqrt((i + 0.5) / kSunDiscRays);
  return {radius * std::cos(kGoldenAngle * i), radius * std::sin(kGoldenAngle * i)};
}

}  // namespace pleinair::clouds
