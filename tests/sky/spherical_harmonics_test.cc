#include "sky/spherical_harmonics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "sky/daylight.h"
#include "sky/sun/sun_position.h"

namespace pleinair::sky {
namespace {

std::unique_ptr<SkyModel> Light(double elevation_deg, SkyCondition condition) {
  const SunPosition sun{FromDegrees(200.0), FromDegrees(elevation_deg), FromDegrees(elevation_deg),
                        1.0};
  return CreateDaylight({condition, 0.0})->ForSun(sun.ToSun(), sun.distance_au);
}

/// Irradiance by a fine sum over the hemisphere.
LinearRgb Integrate(const SkyModel& light, Vec3 normal) {
  constexpr int kRings = 60, kSectors = 120;
  LinearRgb sum;
  for (int i = 0; i < kRings; ++i) {
    const double up = (i + 0.5) / kRings;
    for (int k = 0; k < kSectors; ++k) {
      const double azimuth = 2.0 * M_PI * (k + 0.5) / kSectors;
      const double horizontal = std::sqrt(1.0 - up * up);
      const Vec3 w{horizontal * std::sin(azimuth), horizontal * std::cos(azimuth), up};
      sum = sum + light.SkyRadiance({w}) * std::max(0.0, Dot(w, normal));
    }
  }
  return sum * (2.0 * M_PI / (kRings * kSectors));
}

TEST(SkyHarmonics, GiveTheIrradianceOfEveryNormalToFourPercent) {
  for (const SkyCondition condition : {SkyCondition::kClear, SkyCondition::kHazy,
                                       SkyCondition::kPartlyCloudy, SkyCondition::kOvercast}) {
    for (const double elevation : {5.0, 20.0, 45.0, 70.0}) {
      const auto light = Light(elevation, condition);
      const SkyHarmonics harmonics = ProjectSky(*light);
      double largest = 0.0, worst = 0.0, squares = 0.0;
      int count = 0;
      for (int i = 0; i < 50; ++i) {  // Fibonacci's sphere.
        const double z = 1.0 - (i + 0.5) / 25.0;
        const double a = i * 2.39996323;
        const double r = std::sqrt(1.0 - z * z);
        const Vec3 normal{r * std::cos(a), r * std::sin(a), z};
        const double truth = Luminance(Integrate(*light, normal));
        const double error = Luminance(harmonics.Irradiance({normal})) - truth;
        largest = std::max(largest, truth);
        worst = std::max(worst, std::fabs(error));
        squares += error * error;
        ++count;
      }
      // The hemisphere's cut at a bright horizon and the glow about the sun cost the most.
      EXPECT_LT(worst / largest, 0.04) << elevation;
      EXPECT_LT(std::sqrt(squares / count) / largest, 0.016) << elevation;
    }
  }
}

TEST(SkyHarmonics, GiveTheIlluminanceOfLevelGround) {
  const auto light = Light(40.0, SkyCondition::kClear);
  const LinearRgb irradiance = ProjectSky(*light).Irradiance({{0.0, 0.0, 1.0}});
  EXPECT_NEAR(irradiance.g / light->SkyHorizontalIrradiance().g, 1.0, 0.02);
  EXPECT_NEAR(irradiance.b / light->SkyHorizontalIrradiance().b, 1.0, 0.02);
}

TEST(SkyHarmonics, AreBrighterTowardsTheSunsSide) {
  const auto light = Light(20.0, SkyCondition::kClear);
  const SkyHarmonics harmonics = ProjectSky(*light);
  const Vec3 to_sun = Normalized({light->ToSun().xyz.x, light->ToSun().xyz.y, 0.0});
  EXPECT_GT(Luminance(harmonics.Irradiance({to_sun})),
            1.3 * Luminance(harmonics.Irradiance({-to_sun})));
}

TEST(SkyHarmonics, AreNeverNegative) {
  const SkyHarmonics harmonics = ProjectSky(*Light(3.0, SkyCondition::kClear));
  for (int i = 0; i < 500; ++i) {
    const double z = 1.0 - (i + 0.5) / 250.0;
    const double r = std::sqrt(1.0 - z * z);
    const LinearRgb e = harmonics.Irradiance({{r * std::cos(i * 2.4), r * std::sin(i * 2.4), z}});
    ASSERT_GE(std::min({e.r, e.g, e.b}), 0.0);
  }
}

}  // namespace
}  // namespace pleinair::sky
