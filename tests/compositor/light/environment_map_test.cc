#include "compositor/light/environment_map.h"

#include <gtest/gtest.h>

namespace pleinair::compositor {
namespace {

class EvenSky : public sky::SkyModel {
 public:
  LinearRgb SkyRadiance(Direction<World>) const override { return {2, 3, 4}; }
  LinearRgb SunNormalIrradiance() const override { return {}; }
  LinearRgb SkyHorizontalIrradiance() const override { return {}; }
  Direction<World> ToSun() const override { return {{0, 0, 1}}; }
};

TEST(EnvironmentMap, OfAnEvenSurroundingIsThatRadianceAtEveryRoughness) {
  const EnvironmentMap map = BuildEnvironmentMap(EvenSky(), Mat3{}, {2, 3, 4});
  for (const Image<float>& level : map.levels) {
    for (int y = 0; y < level.height(); y += 5) {
      for (int x = 0; x < level.width(); x += 7) {
        EXPECT_NEAR(level(x, y, 0), 2, 1e-5);
        EXPECT_NEAR(level(x, y, 1), 3, 1e-5);
        EXPECT_NEAR(level(x, y, 2), 4, 1e-5);
      }
    }
  }
}

TEST(EnvironmentMap, HasTheSkyAboveAndTheGroundBelow) {
  const EnvironmentMap map = BuildEnvironmentMap(EvenSky(), Mat3{}, {0.5, 0.5, 0.5});
  EXPECT_NEAR(map.levels[0](10, 0, 0), 2, 1e-5);
  EXPECT_NEAR(map.levels[0](10, EnvironmentMap::kHeight - 1, 0), 0.5, 1e-5);
}

TEST(EnvironmentMap, BlursTheHorizonMoreTheRougherTheSurface) {
  const EnvironmentMap map = BuildEnvironmentMap(EvenSky(), Mat3{}, {0, 0, 0});
  const int just_below = EnvironmentMap::kHeight / 2 + 2;
  for (int level = 1; level < EnvironmentMap::kLevels; ++level) {
    EXPECT_GE(map.levels[level](5, just_below, 0), map.levels[level - 1](5, just_below, 0) - 1e-6);
  }
  EXPECT_GT(map.levels[EnvironmentMap::kLevels - 1](5, just_below, 0), 0.2F);
}

TEST(EnvironmentMap, TurnsWithTheMarker) {
  // The marker's +z axis is the world's north: half of the directions around +z hit the ground.
  const Mat3 marker_from_world{{1, 0, 0, 0, 0, -1, 0, 1, 0}};
  const EnvironmentMap map = BuildEnvironmentMap(EvenSky(), marker_from_world, {0, 0, 0});
  // Marker −y is up in the world: azimuth atan2(−1, 0) = −π/2, a quarter of the width.
  EXPECT_NEAR(map.levels[0](EnvironmentMap::kWidth / 4, EnvironmentMap::kHeight / 2, 0), 2, 1e-5);
  EXPECT_NEAR(map.levels[0](3 * EnvironmentMap::kWidth / 4, EnvironmentMap::kHeight / 2, 0), 0,
              1e-5);
}

}  // namespace
}  // namespace pleinair::compositor
