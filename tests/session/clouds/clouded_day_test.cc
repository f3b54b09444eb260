#include "session/clouds/clouded_day.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "base/units.h"
#include "session/clouds/cloud_shadow.h"
#include "sky/clouds/cloud_sky.h"

namespace pleinair::session {
namespace {

Direction<World> Afternoon(double elevation_deg) {
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{-std::cos(elevation) * 0.6, -std::cos(elevation) * 0.8, std::sin(elevation)}};
}

std::unique_ptr<sky::SkyModel> ClearDay(double elevation_deg) {
  return *sky::CreateSkyModel({sky::SkyModelKind::kAtmosphere, 0}, {}, Afternoon(elevation_deg));
}

clouds::CloudFields OneLayer(const std::string& text) {
  return clouds::MakeFields({clouds::ParseCloudLayer(text).value()});
}

TEST(CloudedDay, HasTheSkyOfTheCloudsAndTheSunAboveThem) {
  for (const char* layer : {"kind=cumulus,cover=0.5", "kind=cirrus", "kind=slab"}) {
    for (const double elevation : {15.0, 50.0}) {
      const clouds::CloudFields fields = OneLayer(layer);
      const CloudedDay day(ClearDay(elevation), {1.0, 1.0, 1.0}, fields, 40.0);
      const clouds::CloudSky sky(ClearDay(elevation), fields, 0.2, 40.0);
      EXPECT_NEAR(
          Luminance(day.SkyHorizontalIrradiance()) / Luminance(sky.SkyHorizontalIrradiance()), 1.0,
          0.02)
          << layer << elevation;
      EXPECT_EQ(day.SunNormalIrradiance().g, ClearDay(elevation)->SunNormalIrradiance().g);
      const Direction<World> up{{0.0, 0.0, 1.0}};
      EXPECT_EQ(day.RadianceSeen(up).g, sky.SkyRadiance(up).g);
      EXPECT_NEAR(day.SkyRadiance(up).g, sky.SkyRadiance(up).g, 0.02 * sky.SkyRadiance(up).g);
    }
  }
}

// The solver samples the sky every few degrees: a narrow peak would light some surfaces only.
TEST(CloudedDay, HasNoPeakAtTheSun) {
  const clouds::CloudFields fields = OneLayer("kind=slab,optical_depth=1");
  const CloudedDay day(ClearDay(50), {1.0, 1.0, 1.0}, fields, 0.0);
  const Vec3 sun = day.ToSun().xyz;
  const Vec3 across = Normalized(Cross(sun, {0.0, 0.0, 1.0}));
  const auto at = [&](double degrees) {
    const double angle = degrees * kRadiansPerDegree;
    return Direction<World>{sun * std::cos(angle) + across * std::sin(angle)};
  };
  EXPECT_GT(day.RadianceSeen(at(0.5)).g, 2.0 * day.RadianceSeen(at(6.0)).g);
  double before = day.SkyRadiance(at(0.0)).g;
  for (int degrees = 1; degrees <= 12; ++degrees) {
    const double here = day.SkyRadiance(at(degrees)).g;
    EXPECT_NEAR(here / before, 1.0, 0.25) << degrees;
    before = here;
  }
}

TEST(CloudedDay, ScalesTheClearSkyAlone) {
  const CloudedDay plain(ClearDay(40), {1.0, 1.0, 1.0}, OneLayer("kind=cirrus,optical_depth=0"),
                         0.0);
  const CloudedDay scaled(ClearDay(40), {2.0, 2.0, 3.0}, OneLayer("kind=cirrus,optical_depth=0"),
                          0.0);
  EXPECT_NEAR(scaled.SkyHorizontalIrradiance().b / plain.SkyHorizontalIrradiance().b, 3.0, 1e-6);
  EXPECT_EQ(scaled.SunNormalIrradiance().b, plain.SunNormalIrradiance().b);
  EXPECT_EQ(plain.SkyRadiance({{0.6, 0.0, -0.8}}).g, 0.0);
}

TEST(CloudShadow, IsRelativeToItsMean) {
  const clouds::CloudFields fields = OneLayer("kind=cumulus,cover=0.5,wind_m_s=10");
  const Mat3 marker_from_world{{0, 1, 0, -1, 0, 0, 0, 0, 1}};  // Its x axis points north.
  const clouds::GroundBox box{{-200, -100, 0}, {200, 100, 8}};
  const Direction<World> sun = Afternoon(40);
  for (const double seconds : {0.0, 30.0, 60.0, 90.0}) {
    const CloudShadow shadow = MakeCloudShadow(fields, box, sun, marker_from_world, seconds);
    ASSERT_TRUE(shadow.map);
    for (const Vec3 place : {Vec3{0, 0, 0}, Vec3{120, -60, 0}, Vec3{-150, 40, 5}}) {
      const double expected = clouds::SunTransmittance(fields, place, sun, seconds);
      EXPECT_NEAR(shadow.map->At(marker_from_world * place) * shadow.sun, expected, 0.03)
          << seconds;
    }
    EXPECT_NEAR(shadow.at_marker, clouds::SunTransmittance(fields, {}, sun, seconds), 0.03);
    EXPECT_TRUE(shadow.map->HoldsFor(marker_from_world * sun.xyz));
  }
}

TEST(CloudShadow, LeavesTheSunAboveThickClouds) {
  const CloudShadow shadow =
      MakeCloudShadow(OneLayer("kind=slab,optical_depth=100"), {}, Afternoon(40), Mat3{}, 0.0);
  EXPECT_EQ(shadow.sun, CloudShadow::kLeastSun);
  EXPECT_LT(shadow.map->At({}), 1e-3);
}

}  // namespace
}  // namespace pleinair::session
