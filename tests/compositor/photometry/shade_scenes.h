#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/vector.h"
#include "compositor/light/sun_transmittance_map.h"
#include "tests/compositor/photometry/photographed_yard.h"

// Unmodelled shade in the yard, and what a map of sunlight must hold of it.

namespace pleinair::compositor::testing {

/// Distance along which stripes of shade alternate, as an angle. The stripes are perpendicular to
/// the sun's rays and cast by distant things: they shade all points along a ray.
inline double StripePhase(const PhotographedYard& yard, Vec3 p) {
  return 7 * Dot(p, Normalized(Cross(Normalized(yard.ToSun()), Vec3{0, 0, 1})));
}

inline PhotographedYard::Light StripedShade(const PhotographedYard& yard) {
  return {.shaded = [&yard](Vec3 p) { return std::sin(StripePhase(yard, p)) > 0.0; }};
}

inline void ExpectStripes(const PhotographedYard& yard, const SunTransmittanceMap& map) {
  const Vec3 to_sun = Normalized(yard.ToSun());
  int right = 0, points = 0;
  for (int column = -8; column <= 8; ++column) {
    for (int row = -8; row <= 2; ++row) {
      const Vec3 ground{0.1 * column, 0.1 * row, 0.0};
      if (!yard.phantoms().IsUnoccluded({ground}, to_sun)) continue;
      const double wave = std::sin(StripePhase(yard, ground));
      if (std::fabs(wave) < 0.3) continue;
      // Above the ground along the ray, where a virtual object could be.
      for (const double above : {0.0, 0.3, 0.6}) {
        ++points;
        right += (map.At(ground + to_sun * above) < 0.5) == (wave > 0.0) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(points, 200);
  EXPECT_GT(right, 0.95 * points);
}

inline bool IsBeneathTree(Vec3 p) { return p.x < -0.9; }

/// Paving with dark joints, a part of it beneath a tree.
inline PhotographedYard::Light ShadeBesideJoints() {
  const auto joints = [](Vec3 p) {
    const auto beside = [](double v) { return std::fabs(v / 0.4 - std::round(v / 0.4)) * 0.4; };
    return p.z < 0.01 && std::min(beside(p.x), beside(p.y)) < 0.015 ? 0.4 : 1.0;
  };
  return {.shaded = IsBeneathTree, .colors_as_described = true, .brighter = joints};
}

/// The joints are no shade. Holds for samples whose exposure no marker binds.
inline void ExpectOpenJoints(const PhotographedYard& yard, const SunTransmittanceMap& map) {
  const Vec3 to_sun = Normalized(yard.ToSun());
  int points = 0, open = 0, dark = 0;
  for (int column = -60; column <= 30; ++column) {
    for (int row = -40; row <= 10; ++row) {
      const Vec3 ground{0.02 * column, 0.02 * row, 0.0};
      const bool on_marker = std::max(std::fabs(ground.x), std::fabs(ground.y)) < 0.22;
      const bool beside_tree = std::fabs(ground.x + 0.9) < 0.15;
      if (on_marker || beside_tree || yard.IsBesideShadowEdge(ground)) continue;
      if (!yard.phantoms().IsUnoccluded({ground}, to_sun)) continue;
      const double share = map.At(ground);
      if (IsBeneathTree(ground)) {
        EXPECT_LT(share, 0.3) << ground.x << ' ' << ground.y;
        continue;
      }
      ++points;
      open += share > 0.95 ? 1 : 0;
      dark += share < 0.7 ? 1 : 0;
    }
  }
  EXPECT_GT(points, 500);
  EXPECT_GT(open, 0.98 * points);
  EXPECT_EQ(dark, 0);
}

}  // namespace pleinair::compositor::testing
