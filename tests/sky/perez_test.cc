#include "sky/perez.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sky/dome.h"

namespace pleinair::sky {
namespace {

Direction<World> Towards(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
           std::sin(elevation)}};
}

double IlluminanceKlx(double turbidity, double elevation_deg) {
  return Luminance(PerezSky(turbidity, Towards(0.0, elevation_deg)).HorizontalIrradiance()) * 1e-3;
}

TEST(PerezSky, HasThePublishedZenith) {
  // Preetham et al. 1999, A.2, by hand for T = 3, sun at 60° from the zenith:
  // χ = (4/9 − 3/120)(π − 2π/3) = 0.43924; Yz = 7.1649 tan χ − 0.6465 + 2.4192 = 5.1392 kcd/m².
  const PerezSky sky(3.0, Towards(120.0, 30.0));
  const XyY zenith = sky.At({{0.0, 0.0, 1.0}});
  EXPECT_NEAR(zenith.luminance, 5139.2, 0.1);
  // [9 3 1] M [θ³ θ² θ 1] with θ = π/3.
  const double t = M_PI / 3.0;
  const double x = 9.0 * (0.00166 * t * t * t - 0.00375 * t * t + 0.00209 * t) +
                   3.0 * (-0.02903 * t * t * t + 0.06377 * t * t - 0.03202 * t + 0.00394) +
                   0.11693 * t * t * t - 0.21196 * t * t + 0.06052 * t + 0.25886;
  EXPECT_NEAR(zenith.x, x, 1e-12);
}

// Horizontal illuminances of the same coefficients, integrated independently (klx).
TEST(PerezSky, HasItsKnownIlluminances) {
  struct Row {
    double elevation_deg, t2, t25, t3, t6;
  };
  for (const Row& row : {Row{2, 16.0, 11.6, 9.9, 6.2}, Row{5, 17.2, 12.9, 11.5, 9.3},
                         Row{10, 19.0, 15.2, 14.2, 14.4}, Row{30, 24.2, 22.8, 24.0, 34.4},
                         Row{60, 24.4, 27.2, 31.5, 56.1}}) {
    EXPECT_NEAR(IlluminanceKlx(2.0, row.elevation_deg), row.t2, 0.06) << row.elevation_deg;
    EXPECT_NEAR(IlluminanceKlx(2.5, row.elevation_deg), row.t25, 0.06) << row.elevation_deg;
    EXPECT_NEAR(IlluminanceKlx(3.0, row.elevation_deg), row.t3, 0.06) << row.elevation_deg;
    EXPECT_NEAR(IlluminanceKlx(6.0, row.elevation_deg), row.t6, 0.06) << row.elevation_deg;
  }
}

TEST(PerezSky, IsNeverNegativeNorInfinite) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    const double turbidity = 2.0 + 8.0 * unit(random);
    const PerezSky sky(turbidity, Towards(360.0 * unit(random), -20.0 + 110.0 * unit(random)));
    const double up = i % 10 == 0 ? 0.0 : unit(random);
    const XyY color = sky.At(Towards(360.0 * unit(random), std::asin(up) / kRadiansPerDegree));
    ASSERT_GT(color.luminance, 0.0);
    ASSERT_LT(color.luminance, 1e6);
    ASSERT_GT(color.x, 0.1);
    ASSERT_LT(color.x, 0.6);
    ASSERT_GT(color.y, 0.1);
    ASSERT_LT(color.y, 0.6);
    const LinearRgb rgb = RgbFromXyY(color);
    ASSERT_GE(std::min({rgb.r, rgb.g, rgb.b}), 0.0);
    ASSERT_NEAR(Luminance(rgb), color.luminance, 1e-9 * color.luminance);
  }
}

TEST(PerezSky, ClampsTurbidityAndSaysSo) {
  const Direction<World> sun = Towards(180.0, 30.0);
  EXPECT_FALSE(PerezSky(2.0, sun).TurbidityWasClamped());
  EXPECT_FALSE(PerezSky(10.0, sun).TurbidityWasClamped());
  for (const double turbidity : {1.0, 1.5, -3.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(PerezSky(turbidity, sun).TurbidityWasClamped());
    EXPECT_EQ(PerezSky(turbidity, sun).turbidity(), 2.0);
  }
  for (const double turbidity : {10.1, 64.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(PerezSky(turbidity, sun).TurbidityWasClamped());
    EXPECT_EQ(PerezSky(turbidity, sun).turbidity(), 10.0);
  }
}

TEST(PerezSky, IsBlackBelowTheHorizon) {
  const PerezSky sky(2.5, Towards(180.0, 30.0));
  EXPECT_EQ(sky.Radiance(Towards(10.0, -0.1)), LinearRgb{});
}

TEST(PerezSky, IsBrightestAroundTheSunAndBlueAwayFromIt) {
  const PerezSky sky(2.5, Towards(180.0, 40.0));
  EXPECT_GT(sky.At(Towards(180.0, 40.0)).luminance, 4.0 * sky.At(Towards(0.0, 50.0)).luminance);
  const LinearRgb away = sky.Radiance(Towards(0.0, 50.0));
  EXPECT_GT(away.b, 2.0 * away.r);
}

TEST(PerezSky, IsContinuousAsTheSunSets) {
  double last = IlluminanceKlx(2.5, 1.0);
  for (double elevation = 0.95; elevation > -19.0; elevation -= 0.05) {
    const double now = IlluminanceKlx(2.5, elevation);
    ASSERT_GT(now, 0.0);
    ASSERT_LE(now, last * 1.0001) << elevation;
    ASSERT_GT(now, 0.9 * last) << elevation;
    last = now;
  }
}

TEST(PerezSky, TakesASunAtTheNadir) {
  const LinearRgb zenith = PerezSky(2.5, {{0.0, 0.0, -1.0}}).Radiance({{0.0, 0.0, 1.0}});
  EXPECT_GT(zenith.b, 0.0);
}

TEST(DomeIntegral, OfAnEvenSkyIsPi) {
  EXPECT_NEAR(IntegrateProjectedDome([](Direction<World>) { return 1.0; }), M_PI, 1e-12);
}

TEST(DomeIntegral, AgreesWithAFineQuadrature) {
  for (const double elevation : {1.0, 20.0, 45.0, 88.0}) {
    const PerezSky sky(2.5, Towards(77.0, elevation));
    double sum = 0.0;
    constexpr int kRings = 600, kSectors = 900;
    for (int i = 0; i < kRings; ++i) {
      const double theta = 0.5 * M_PI * (i + 0.5) / kRings;
      for (int k = 0; k < kSectors; ++k) {
        const Direction<World> from =
            Towards(360.0 * (k + 0.5) / kSectors, 90.0 - theta / kRadiansPerDegree);
        sum += sky.At(from).luminance * std::cos(theta) * std::sin(theta);
      }
    }
    sum *= 0.5 * M_PI / kRings * 2.0 * M_PI / kSectors;
    EXPECT_NEAR(Luminance(sky.HorizontalIrradiance()) / sum, 1.0, 3e-4) << elevation;
  }
}

TEST(Color, TakesD65ToWhite) {
  const LinearRgb white = RgbFromXyY({0.3127, 0.3290, 100.0});
  EXPECT_NEAR(white.r, 100.0, 0.1);
  EXPECT_NEAR(white.g, 100.0, 0.1);
  EXPECT_NEAR(white.b, 100.0, 0.1);
}

TEST(Color, KeepsLuminanceWhenItClips) {
  const LinearRgb cyan = RgbFromXyY({0.1, 0.35, 50.0});
  EXPECT_EQ(cyan.r, 0.0);
  EXPECT_NEAR(Luminance(cyan), 50.0, 1e-12);
}

}  // namespace
}  // namespace pleinair::sky
