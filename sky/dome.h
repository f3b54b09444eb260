#pragma once

#include <cmath>
#include <numbers>

#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::sky {

/// Integral over the upper hemisphere of f(direction) · cos θ dω: horizontal irradiance, for f a
/// radiance. Midpoint rule in cos²θ (rings of equal projected solid angle) and azimuth (sectors).
/// With the default 8,192 directions the error is 3e-4 for smooth skies (tests/sky/perez_test.cc)
/// and 1.3e-3 for a narrow bright aureole (cie:15). `Value` needs operator+ and a product with
/// double.
template <int kRings = 64, int kSectors = 128, typename Function>
auto IntegrateProjectedDome(const Function& f) {
  decltype(f(Direction<World>{})) sum{};
  for (int ring = 0; ring < kRings; ++ring) {
    const double cos2 = (ring + 0.5) / kRings;
    const double up = std::sqrt(cos2);
    const double horizontal = std::sqrt(1.0 - cos2);
    for (int sector = 0; sector < kSectors; ++sector) {
      const double azimuth = 2.0 * std::numbers::pi * (sector + 0.5) / kSectors;
      sum =
          sum +
          f(Direction<World>{{horizontal * std::sin(azimuth), horizontal * std::cos(azimuth), up}});
    }
  }
  return sum * (std::numbers::pi / (kRings * kSectors));
}

}  // namespace pleinair::sky
