#include "sky/daylight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sky/air_mass.h"
#include "sky/dome.h"
#include "sky/standard_illuminance.h"
#include "sky/sunlight_spectrum.h"

namespace pleinair::sky {
namespace {

SunPosition SunAt(double elevation_deg, double azimuth_deg = 135.0, double distance_au = 1.0) {
  return {FromDegrees(azimuth_deg), FromDegrees(elevation_deg), FromDegrees(elevation_deg),
          distance_au};
}

constexpr SkyCondition kConditions[] = {SkyCondition::kClear, SkyCondition::kHazy,
                                        SkyCondition::kPartlyCloudy, SkyCondition::kOvercast};

struct Share {
  double sun_normal_klx, sky_klx, diffuse_share;
};

Share Measure(double elevation_deg, SkyCondition condition, double turbidity = 0.0) {
  const auto light = CreateDaylight(SunAt(elevation_deg), {condition, turbidity});
  const double sun = Luminance(light->SunNormalIrradiance());
  const double sky = Luminance(light->SkyHorizontalIrradiance());
  return {sun * 1e-3, sky * 1e-3, sky / (sky + sun * light->ToSun().xyz.z)};
}

// IES RP-21, evaluated independently.
TEST(Daylight, HasTheIesIlluminancesOfAClearDay) {
  for (const auto& [elevation, sky_klx, sun_klx] :
       {std::array{10.0, 7.26, 38.1}, {30.0, 11.76, 83.8}, {60.0, 15.22, 100.1}}) {
    EXPECT_NEAR(Measure(elevation, SkyCondition::kClear).sky_klx, sky_klx, 0.01);
    EXPECT_NEAR(Measure(elevation, SkyCondition::kClear).sun_normal_klx, sun_klx, 0.1);
  }
}

TEST(Daylight, HasTheIesIlluminancesUnderClouds) {
  const Share partly = Measure(30.0, SkyCondition::kPartlyCloudy);
  EXPECT_NEAR(partly.sky_klx, 22.8, 0.01);
  EXPECT_NEAR(partly.sun_normal_klx, 127.5 * std::exp(-1.6), 0.01);
  const Share overcast = Measure(30.0, SkyCondition::kOvercast);
  EXPECT_NEAR(overcast.sky_klx, 10.8, 0.01);
  EXPECT_EQ(overcast.sun_normal_klx, 0.0);
}

TEST(Daylight, FollowsTheDistanceOfTheSun) {
  const double january =
      Luminance(CreateDaylight(SunAt(30.0, 0.0, 0.98329), {})->SunNormalIrradiance());
  const double july =
      Luminance(CreateDaylight(SunAt(30.0, 0.0, 1.01669), {})->SunNormalIrradiance());
  EXPECT_NEAR(january / july, 1.0691, 1e-3);  // IES: (1 + 0.034) / (1 − 0.034) = 1.070.
}

TEST(Daylight, IsMoreDiffuseInHaze) {
  const double clear = Measure(30.0, SkyCondition::kClear).diffuse_share;
  const double hazy = Measure(30.0, SkyCondition::kHazy).diffuse_share;
  EXPECT_NEAR(clear, 0.219, 0.002);
  EXPECT_GT(hazy, 0.35);
  EXPECT_LT(hazy, 0.45);
  EXPECT_GT(Measure(30.0, SkyCondition::kClear, 6.0).diffuse_share, hazy);
  EXPECT_LT(Measure(30.0, SkyCondition::kClear, 2.0).diffuse_share, clear);
}

TEST(Daylight, IntegratesToItsHorizontalIrradiance) {
  for (const SkyCondition condition : kConditions) {
    for (const double elevation : {-5.0, 3.0, 40.0, 80.0}) {
      const auto light = CreateDaylight(SunAt(elevation), {condition, 0.0});
      const LinearRgb integral =
          IntegrateProjectedDome([&](Direction<World> from) { return light->SkyRadiance(from); });
      const LinearRgb told = light->SkyHorizontalIrradiance();
      EXPECT_NEAR(integral.r / told.r, 1.0, 1e-9);
      EXPECT_NEAR(integral.g / told.g, 1.0, 1e-9);
      EXPECT_NEAR(integral.b / told.b, 1.0, 1e-9);
    }
  }
}

TEST(Daylight, IsContinuousFromNoonToNight) {
  for (const SkyCondition condition : kConditions) {
    Share last = Measure(60.0, condition);
    for (double elevation = 59.95; elevation > -20.0; elevation -= 0.05) {
      const Share now = Measure(elevation, condition);
      // The steepest: IES' √(sin a) where it meets the horizon, and the disc, which sets in 0.53°.
      ASSERT_NEAR(now.sky_klx, last.sky_klx, 0.06 * last.sky_klx + 0.5) << elevation;
      ASSERT_NEAR(now.sun_normal_klx, last.sun_normal_klx, 0.5) << elevation;
      ASSERT_GT(now.sky_klx, 0.0);
      last = now;
    }
    EXPECT_EQ(last.sun_normal_klx, 0.0);
  }
}

TEST(Daylight, HasAWarmLowSunAndABlueSky) {
  for (const double elevation : {5.0, 20.0, 45.0, 70.0}) {
    const auto light = CreateDaylight(SunAt(elevation), {});
    const LinearRgb sun = light->SunNormalIrradiance();
    const LinearRgb sky = light->SkyHorizontalIrradiance();
    EXPECT_GT(sun.r, sun.g);
    EXPECT_GT(sun.g, sun.b);
    EXPECT_GT(sky.b, sky.g);
    EXPECT_GT(sky.g, sky.r);
  }
  const LinearRgb low = CreateDaylight(SunAt(5.0), {})->SunNormalIrradiance();
  const LinearRgb high = CreateDaylight(SunAt(70.0), {})->SunNormalIrradiance();
  EXPECT_LT(low.b / low.r, 0.5 * high.b / high.r);
}

TEST(Daylight, IsWhiteAtNoonFromSunAndSkyTogether) {
  // CIE D55: daylight of a high sun with its sky, 5500 K; x = 0.3324, y = 0.3474 is
  // linear Rec.709 (1.10, 0.99, 0.77)…, D65 is (1, 1, 1). Together they lie between.
  const auto light = CreateDaylight(SunAt(50.0), {});
  const LinearRgb sum =
      light->SunNormalIrradiance() * light->ToSun().xyz.z + light->SkyHorizontalIrradiance();
  EXPECT_GT(sum.r / sum.g, 1.0);
  EXPECT_LT(sum.r / sum.g, 1.15);
  EXPECT_GT(sum.b / sum.g, 0.85);
  EXPECT_LT(sum.b / sum.g, 1.05);
}

TEST(Daylight, IsBlackBelowTheHorizon) {
  for (const SkyCondition condition : kConditions) {
    EXPECT_EQ(CreateDaylight(SunAt(30.0), {condition, 0.0})->SkyRadiance({{0.6, 0.0, -0.8}}),
              LinearRgb{});
  }
}

// ISO 15469:2004, type 1; the table's L_zenith / E for it is 0.4082.
TEST(OvercastSky, IsTheCieStandardOne) {
  const auto light = CreateDaylight(SunAt(30.0), {SkyCondition::kOvercast, 0.0});
  const double zenith = light->SkyRadiance({{0.0, 0.0, 1.0}}).g;
  const double horizon = light->SkyRadiance({{1.0, 0.0, 0.0}}).g;
  EXPECT_NEAR(zenith / light->SkyHorizontalIrradiance().g, 0.4082, 2e-4);
  EXPECT_NEAR(horizon / zenith, 1.0 / (1.0 + 4.0 * std::exp(-0.7)), 1e-6);
}

TEST(OvercastSky, HasNoColour) {
  const auto light = CreateDaylight(SunAt(30.0), {SkyCondition::kOvercast, 0.0});
  const LinearRgb sky = light->SkyRadiance({{0.6, 0.0, 0.8}});
  EXPECT_EQ(sky.r, sky.g);
  EXPECT_EQ(sky.g, sky.b);
}

// Kasten & Young 1989, Table: 1.0 at 90°, 1.993 at 30°, 5.586 at 10°, 10.31 at 5°, 37.92 at 0°.
TEST(AirMass, IsKastenAndYoungs) {
  for (const auto& [elevation_deg, mass] :
       {std::pair{90.0, 0.9997}, {30.0, 1.9939}, {10.0, 5.5841}, {5.0, 10.306}, {0.0, 37.920}}) {
    EXPECT_NEAR(RelativeAirMass(FromDegrees(elevation_deg)) / mass, 1.0, 1e-3) << elevation_deg;
  }
}

TEST(Sunlight, HasTheSolarIlluminanceConstant) {
  // IES: 127.5 klx outside the atmosphere; other sources up to 133.
  const Radians zenith = FromDegrees(90.0);
  const double outside =
      Luminance(DirectSunIrradiance(2.5, zenith, 1.0)) / LuminousTransmittance(2.5, zenith);
  EXPECT_NEAR(outside, 127'500.0, 3'000.0);
}

TEST(Sunlight, IsNearTheIesExtinctionAtTheClearTurbidity) {
  // IES: e^(−0.21 m).
  for (const double elevation : {30.0, 45.0, 60.0, 90.0}) {
    const double mass = 1.0 / std::sin(elevation * kRadiansPerDegree);
    EXPECT_NEAR(LuminousTransmittance(2.5, FromDegrees(elevation)), std::exp(-0.21 * mass), 0.13)
        << elevation;
  }
}

TEST(Sunlight, DimsAndReddensWithTurbidity) {
  double last = 1.0;
  double last_blue = 10.0;
  for (double turbidity = 2.0; turbidity <= 10.0; turbidity += 0.5) {
    const double now = LuminousTransmittance(turbidity, FromDegrees(30.0));
    const LinearRgb light = DirectSunIrradiance(turbidity, FromDegrees(30.0), 1.0);
    EXPECT_LT(now, last);
    EXPECT_LT(light.b / light.r, last_blue);
    last = now;
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
