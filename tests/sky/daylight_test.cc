#include "sky/daylight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "sky/air_mass.h"
#include "sky/dome.h"
#include "sky/standard_illuminance.h"
#include "sky/sun/sun_position.h"
#include "sky/sunlight_spectrum.h"

namespace pleinair::sky {
namespace {

SunPosition SunAt(double elevation_deg, double azimuth_deg = 135.0, double distance_au = 1.0) {
  return {FromDegrees(azimuth_deg), FromDegrees(elevation_deg), FromDegrees(elevation_deg),
          distance_au};
}

constexpr SkyCondition kConditions[] = {SkyCondition::kClear, SkyCondition::kHazy,
                                        SkyCondition::kPartlyCloudy, SkyCondition::kOvercast};

/// The skies of a condition, computed once for all tests.
const SkySource& SkiesOf(SkyCondition condition) {
  static std::map<SkyCondition, std::shared_ptr<const SkySource>> skies;
  std::shared_ptr<const SkySource>& source = skies[condition];
  if (source == nullptr) source = CreateDaylight({condition, 0.0});
  return *source;
}

std::unique_ptr<SkyModel> Light(double elevation_deg, SkyCondition condition) {
  return SkiesOf(condition).ForSun(SunAt(elevation_deg).ToSun(), 1.0);
}

struct Share {
  double sun_normal_klx, sky_klx, diffuse_share;
};

Share Measure(const SkyModel& light) {
  const double sun = Luminance(light.SunNormalIrradiance());
  const double sky = Luminance(light.SkyHorizontalIrradiance());
  const double up = std::max(0.0, light.ToSun().xyz.z);
  return {sun * 1e-3, sky * 1e-3, sky / (sky + sun * up)};
}

TEST(Daylight, IsMoreDiffuseInHazeAndUnderClouds) {
  const double clear = Measure(*Light(30.0, SkyCondition::kClear)).diffuse_share;
  const double hazy = Measure(*Light(30.0, SkyCondition::kHazy)).diffuse_share;
  const double partly = Measure(*Light(30.0, SkyCondition::kPartlyCloudy)).diffuse_share;
  EXPECT_NEAR(clear, 0.219, 0.01);  // IES RP-21, clear.
  EXPECT_NEAR(hazy, 0.40, 0.03);
  EXPECT_NEAR(partly, 0.55, 0.08);
  EXPECT_EQ(Measure(*Light(30.0, SkyCondition::kOvercast)).diffuse_share, 1.0);
}

TEST(Daylight, TakesATurbidityInPlaceOfTheConditions) {
  const auto measure = [](double turbidity) {
    const auto source = CreateDaylight({SkyCondition::kClear, turbidity});
    return Measure(*source->ForSun(SunAt(30.0).ToSun(), 1.0));
  };
  EXPECT_LT(measure(1.2).diffuse_share, measure(2.0).diffuse_share);
  EXPECT_LT(measure(2.0).diffuse_share, measure(6.0).diffuse_share);
  EXPECT_EQ(measure(64.0).sky_klx, measure(kMaxTurbidity).sky_klx);
  EXPECT_EQ(measure(std::numeric_limits<double>::quiet_NaN()).sky_klx,
            measure(kMinTurbidity).sky_klx);
}

TEST(Daylight, IntegratesToItsHorizontalIrradiance) {
  for (const SkyCondition condition : kConditions) {
    for (const double elevation : {-5.0, 3.0, 40.0, 80.0}) {
      const auto light = Light(elevation, condition);
      const LinearRgb integral =
          IntegrateProjectedDome([&](Direction<World> from) { return light->SkyRadiance(from); });
      const LinearRgb told = light->SkyHorizontalIrradiance();
      EXPECT_NEAR(integral.r / told.r, 1.0, 3e-4);
      EXPECT_NEAR(integral.g / told.g, 1.0, 3e-4);
      EXPECT_NEAR(integral.b / told.b, 1.0, 3e-4);
    }
  }
}

TEST(Daylight, IsContinuousFromNoonToNight) {
  for (const SkyCondition condition : {SkyCondition::kClear, SkyCondition::kPartlyCloudy}) {
    Share last = Measure(*Light(30.0, condition));
    for (double elevation = 29.5; elevation > -20.0;
         elevation -= elevation > 3.0 || elevation < -8.0 ? 0.5 : 0.1) {
      const Share now = Measure(*Light(elevation, condition));
      // In deep twilight the light falls by 13 % in 0.1°.
      const double most = elevation < -8.0 ? 0.8 : 0.15;
      ASSERT_NEAR(now.sky_klx, last.sky_klx, most * last.sky_klx) << elevation;
      ASSERT_LE(now.sun_normal_klx, last.sun_normal_klx) << elevation;
      ASSERT_GT(now.sky_klx, 0.0);
      last = now;
    }
    EXPECT_EQ(last.sun_normal_klx, 0.0);
  }
}

TEST(Daylight, HasAWarmLowSunAndABlueSky) {
  for (const double elevation : {5.0, 20.0, 45.0, 70.0}) {
    const auto light = Light(elevation, SkyCondition::kClear);
    const LinearRgb sun = light->SunNormalIrradiance();
    const LinearRgb sky = light->SkyHorizontalIrradiance();
    EXPECT_GT(sun.r, sun.g);
    EXPECT_GT(sun.g, sun.b);
    EXPECT_GT(sky.b, sky.g);
    EXPECT_GT(sky.g, sky.r);
  }
  const LinearRgb low = Light(5.0, SkyCondition::kClear)->SunNormalIrradiance();
  const LinearRgb high = Light(70.0, SkyCondition::kClear)->SunNormalIrradiance();
  EXPECT_LT(low.b / low.r, 0.5 * high.b / high.r);
}

TEST(Daylight, IsWhiteAtNoonFromSunAndSkyTogether) {
  // CIE D55, daylight of a high sun with its sky, has 5500 K. Its x = 0.3324, y = 0.3474 is linear
  // Rec.709 (1.10, 0.99, 0.77)…; D65 is (1, 1, 1). The sum lies between them.
  const auto light = Light(50.0, SkyCondition::kClear);
  const LinearRgb sum =
      light->SunNormalIrradiance() * light->ToSun().xyz.z + light->SkyHorizontalIrradiance();
  EXPECT_GT(sum.r / sum.g, 1.0);
  EXPECT_LT(sum.r / sum.g, 1.15);
  EXPECT_GT(sum.b / sum.g, 0.80);
  EXPECT_LT(sum.b / sum.g, 1.05);
}

TEST(Daylight, IsBlackBelowTheHorizon) {
  for (const SkyCondition condition : kConditions) {
    EXPECT_EQ(Light(30.0, condition)->SkyRadiance({{0.6, 0.0, -0.8}}), LinearRgb{});
  }
}

TEST(OvercastSky, HasNoColor) {
  const LinearRgb sky = Light(30.0, SkyCondition::kOvercast)->SkyRadiance({{0.6, 0.0, 0.8}});
  EXPECT_NEAR(sky.r / sky.g, 1.0, 1e-12);
  EXPECT_NEAR(sky.b / sky.g, 1.0, 1e-12);
}

// IES RP-21, calculated independently.
TEST(StandardIlluminance, HasTheFiguresOfTheIes) {
  struct Row {
    SkyCondition condition;
    double elevation, sky_klx, sun_klx;
  };
  for (const Row& row : {Row{SkyCondition::kClear, 10.0, 7.26, 38.1},
                         {SkyCondition::kClear, 30.0, 11.76, 83.8},
                         {SkyCondition::kClear, 60.0, 15.22, 100.1},
                         {SkyCondition::kPartlyCloudy, 30.0, 22.8, 25.7},
                         {SkyCondition::kOvercast, 30.0, 10.8, 0.0}}) {
    const StandardIlluminance light =
        ComputeStandardIlluminance(row.condition, FromDegrees(row.elevation), 1.0);
    EXPECT_NEAR(light.sky_horizontal.value() * 1e-3, row.sky_klx, 0.01);
    EXPECT_NEAR(light.sun_normal.value() * 1e-3, row.sun_klx, 0.1);
  }
}

TEST(StandardIlluminance, FollowsTheDistanceOfTheSun) {
  const auto sun = [](double distance) {
    return ComputeStandardIlluminance(SkyCondition::kClear, FromDegrees(30.0), distance)
        .sun_normal.value();
  };
  EXPECT_NEAR(sun(0.98329) / sun(1.01669), 1.0691, 1e-3);  // IES: 1.034 / 0.966 = 1.070.
}

// Kasten & Young 1989, Table: 1.0 at 90°, 1.993 at 30°, 5.586 at 10°, 10.31 at 5°, 37.92 at 0°.
TEST(AirMass, IsKastenAndYoungs) {
  for (const auto& [elevation_deg, mass] :
       {std::pair{90.0, 0.9997}, {30.0, 1.9939}, {10.0, 5.5841}, {5.0, 10.306}, {0.0, 37.920}}) {
    EXPECT_NEAR(RelativeAirMass(FromDegrees(elevation_deg)) / mass, 1.0, 1e-3) << elevation_deg;
  }
}

TEST(Sunlight, IsNearTheIesExtinctionOnAClearDay) {
  // IES: 127.5 klx e^(−0.21 m).
  for (const double elevation : {30.0, 45.0, 60.0, 90.0}) {
    const double mass = 1.0 / std::sin(elevation * kRadiansPerDegree);
    const double passed =
        Luminance(DirectSunIrradiance(2.5, FromDegrees(elevation), 1.0)) / 127'500.0;
    EXPECT_NEAR(passed, std::exp(-0.21 * mass), 0.13) << elevation;
  }
}

TEST(Sunlight, DimsAndReddensWithTurbidity) {
  double last = 2e5;
  double last_blue = 10.0;
  for (double turbidity = 2.0; turbidity <= 10.0; turbidity += 0.5) {
    const LinearRgb light = DirectSunIrradiance(turbidity, FromDegrees(30.0), 1.0);
    EXPECT_LT(Luminance(light), last);
    EXPECT_LT(light.b / light.r, last_blue);
    last = Luminance(light);
    last_blue = light.b / light.r;
  }
}

TEST(Sunlight, HasNoNegativeChannel) {
  for (double elevation = -2.0; elevation <= 90.0; elevation += 0.1) {
    const LinearRgb light = DirectSunIrradiance(6.0, FromDegrees(elevation), 1.0);
    ASSERT_GE(std::min({light.r, light.g, light.b}), 0.0) << elevation;
  }
}

}  // namespace
}  // namespace pleinair::sky
