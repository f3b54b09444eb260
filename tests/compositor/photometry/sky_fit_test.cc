#include "compositor/photometry/sky_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pleinair::compositor {
namespace {

Direction<World> Sun(double elevation_deg) {
  const double elevation = FromDegrees(elevation_deg).value();
  return {{0.0, -std::cos(elevation), std::sin(elevation)}};
}

double Share(const sky::SkyModel& day) {
  return Luminance(day.SkyHorizontalIrradiance()) / Luminance(day.SunNormalIrradiance());
}

TEST(SkyWithShare, HasTheShapeOfAnAirWhoseSkyIsThatStrong) {
  // From a clear day through haze to a sun behind thin clouds.
  for (const double elevation_deg : {12.0, 60.0}) {
    for (const double share : {0.2, 0.6, 3.0}) {
      const SkyFit sky = SkyWithShare({share, share, share}, Sun(elevation_deg), 1.0);
      const auto day = sky.skies->ForSun(Sun(elevation_deg), 1.0);
      EXPECT_NEAR(std::log(Share(*day) / share), 0.0, 0.012) << elevation_deg << "°, " << share;
      const double whole = Luminance(day->SkyHorizontalIrradiance() * sky.sky_radiance_scale /
                                     day->SunNormalIrradiance());
      EXPECT_NEAR(whole / share, 1.0, 1e-9) << "each channel has what it lacks";
    }
  }
}

TEST(SkyWithShare, IsScaledWhereNoAirIsThatClear) {
  const SkyFit sky = SkyWithShare({0.02, 0.02, 0.02}, Sun(40.0), 1.0);
  EXPECT_LT(Luminance(sky.sky_radiance_scale), 0.5);
  EXPECT_GT(Luminance(sky.sky_radiance_scale), 0.05);
}

TEST(SkyWithShare, IsOvercastWhereThereIsNoSunToBeBeside) {
  const double nothing = std::nan("");
  for (const double share : {nothing, 0.0, HUGE_VAL}) {
    const SkyFit sky = SkyWithShare({share, share, share}, Sun(-20.0), 1.0);
    EXPECT_EQ(Luminance(sky.sky_radiance_scale), 1.0);
    EXPECT_EQ(Luminance(sky.skies->ForSun(Sun(-20.0), 1.0)->SunNormalIrradiance()), 0.0);
  }
}

TEST(SkyWithShare, StaysFiniteBehindTheThickestClouds) {
  const SkyFit sky = SkyWithShare({500.0, 500.0, 500.0}, Sun(40.0), 1.0);
  EXPECT_TRUE(std::isfinite(Luminance(sky.sky_radiance_scale)));
  EXPECT_GT(Luminance(sky.sky_radiance_scale), 1.0);
}

}  // namespace
}  // namespace pleinair::compositor
