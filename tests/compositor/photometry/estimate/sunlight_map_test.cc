// Tests the map of unmodelled shade on images with known light.
#include "compositor/photometry/estimate/sunlight_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compositor/light/sun_transmittance_map.h"
#include "tests/compositor/photometry/estimate/fitted_yard.h"

namespace pleinair::compositor {
namespace {

using testing::FittedYard;
constexpr Vec3 kUp{0, 0, 1};

TEST_F(FittedYard, MapsWhereTheSunComesThroughTrees) {
  // Stripes perpendicular to the sun's rays, cast by distant objects. They shade all points along a
  // ray.
  const Vec3 to_sun = Normalized(yard_->model().ToSun().xyz);
  const Vec3 across = Normalized(Cross(to_sun, kUp));
  const auto tree = [&](Vec3 p) { return std::sin(7 * Dot(p, across)) > 0.0; };
  const SurfaceSamples samples = Look({.shaded = tree});
  const SunTransmittanceMap map = Fit(samples).Map(samples, yard_->phantoms());
  int right = 0, points = 0;
  for (int column = -8; column <= 8; ++column) {
    for (int row = -8; row <= 2; ++row) {
      const Vec3 ground{0.1 * column, 0.1 * row, 0.0};
      if (!yard_->phantoms().IsUnoccluded({ground}, to_sun)) continue;
      // Above the ground along the ray, where a virtual object could be.
      for (const double above : {0.0, 0.3, 0.6}) {
        if (std::fabs(std::sin(7 * Dot(ground, across))) < 0.3) continue;
        ++points;
        const double share = map.At(ground + to_sun * above);
        right += (share < 0.5) == tree(ground) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(points, 200);
  EXPECT_GT(right, 0.95 * points);
}

TEST_F(FittedYard, MapsNoShadeWherePavingHasDarkJoints) {
  const auto tree = [](Vec3 p) { return p.x < -0.9; };
  const auto joints = [](Vec3 p) {
    const auto beside = [](double v) { return std::fabs(v / 0.4 - std::round(v / 0.4)) * 0.4; };
    return p.z < 0.01 && std::min(beside(p.x), beside(p.y)) < 0.015 ? 0.4 : 1.0;
  };
  const SurfaceSamples samples =
      Look({.shaded = tree, .colors_as_described = true, .brighter = joints});
  const SunTransmittanceMap map = Fit(samples).Map(samples, yard_->phantoms());
  const Vec3 to_sun = Normalized(yard_->model().ToSun().xyz);
  int points = 0, open = 0, dark = 0;
  for (int column = -60; column <= 30; ++column) {
    for (int row = -40; row <= 10; ++row) {
      const Vec3 ground{0.02 * column, 0.02 * row, 0.0};
      // Look() takes no exposure from the marker, so that its white counts for nothing here.
      const bool on_marker = std::max(std::fabs(ground.x), std::fabs(ground.y)) < 0.22;
      const bool beside_tree = std::fabs(ground.x + 0.9) < 0.15;
      if (on_marker || beside_tree || yard_->IsBesideShadowEdge(ground)) continue;
      if (!yard_->phantoms().IsUnoccluded({ground}, to_sun)) continue;
      const double share = map.At(ground);
      if (tree(ground)) {
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

TEST(SunTransmittanceMap, IsEmptyWhereAFewSamplesLieInOppositeCorners) {
  // The quantiles along either axis exclude one of them.
  const SunTransmittanceMap aim =
      BuildSunTransmittanceMap({0.3, 0.2, 1.0}, std::vector<SunlitSample>{{{}, 1, 0.1}});
  const std::vector<SunlitSample> surface_samples{{aim.across_y * 1.0, 0.3, 0.1},
                                                  {aim.across_x * 1.0, 1, 0.1}};
  const SunTransmittanceMap map = BuildSunTransmittanceMap({0.3, 0.2, 1.0}, surface_samples);
  EXPECT_TRUE(map.share.empty());
  EXPECT_EQ(map.At({}), 1.0);
}

}  // namespace
}  // namespace pleinair::compositor
