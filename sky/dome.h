#pragma once

#include <cmath>
#include <numbers>

#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::sky {

/// Integral over the upper hemisphere of f(direction) · cos θ dω, for f a radiance: horizontal
/// irradiance. Midpoint rule in cos²θ (64 rings of equal projected solid angle) and azimuth (128
/// sectors), 8,192 directions: relative error below 3e-4 for the skies of this module
/// (tests/sky/perez_test.cc). `Value` needs + and a product with double.
template <typename Function>
auto IntegrateProjectedDome(const Function& f) {
  constexpr int kRings = 64;
  constexpr int kSectors = 128;
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
