#include "sky/cie_sky.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sky/dome.h"
#include "sky/sky_model.h"

namespace pleinair::sky {
namespace {

Direction<World> Towards(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
           std::sin(elevation)}};
}

constexpr Direction<World> kZenith{{0.0, 0.0, 1.0}};

constexpr std::array<double, 4> kElevations = {15.0, 30.0, 45.0, 60.0};

// Zenith luminance over horizontal illuminance, integrated independently from the standard's
// parameters. Cross-checked with two published test tables.
constexpr std::array<std::array<double, 4>, 15> kZenithOverIlluminance = {{
    {.4082, .4082, .4082, .4082},
    {.3757, .3911, .4231, .4794},
    {.3610, .3610, .3610, .3610},
    {.3301, .3460, .3778, .4319},
    {.3183, .3183, .3183, .3183},
    {.2894, .3051, .3359, .3870},
    {.2563, .2723, .3182, .4130},
    {.2262, .2425, .2995, .4295},
    {.2055, .2196, .2464, .2891},
    {.1788, .1944, .2351, .3154},
    {.1550, .1719, .2229, .3346},
    {.1388, .1564, .2062, .3134},
    {.1239, .1430, .2007, .3305},
    {.1097, .1297, .1860, .3109},
    {.0967, .1232, .1897, .3316},
}};

TEST(CieSky, HasThePublishedZenithOverIlluminanceToOnePerMille) {
  for (int type = 1; type <= 15; ++type) {
    for (int i = 0; i < 4; ++i) {
      const CieSky sky(type, Towards(200.0, kElevations[i]));
      const double expected = kZenithOverIlluminance[type - 1][i];
      EXPECT_NEAR(1.0 / sky.IlluminanceOverZenith(), expected, 1e-3 * expected)
          << "type " << type << ", sun " << kElevations[i];
    }
  }
}

TEST(CieSky, OfTypeFiveIsUniform) {
  const CieSky sky(5, Towards(10.0, 30.0));
  EXPECT_NEAR(sky.IlluminanceOverZenith(), M_PI, 1e-6);
  EXPECT_EQ(sky.RelativeLuminance(Towards(77.0, 3.0)), 1.0);
}

// Radiance's gensky: (0.91 + 10 e^(−3 γ) + 0.45 cos² γ)(1 − e^(−0.32 / cos Z)) / (0.274 (…)).
TEST(CieSky, OfTypeTwelveIsGenskysClearSky) {
  const Direction<World> sun = Towards(90.0, 40.0);
  const CieSky sky(12, sun);
  const auto gensky = [&](Direction<World> from) {
    const double gamma = std::acos(Dot(from.xyz, sun.xyz));
    return (0.91 + 10.0 * std::exp(-3.0 * gamma) + 0.45 * std::cos(gamma) * std::cos(gamma)) *
           (1.0 - std::exp(-0.32 / from.xyz.z));
  };
  for (const auto& from : {Towards(90.0, 60.0), Towards(0.0, 20.0), Towards(270.0, 5.0)}) {
    EXPECT_NEAR(sky.RelativeLuminance(from), gensky(from) / gensky(kZenith), 2e-3);
  }
}

TEST(CieSky, IsOneAtTheZenithAndNeverNegative) {
  for (int type = 1; type <= 15; ++type) {
    for (double sun = -6.0; sun <= 90.0; sun += 3.0) {
      const CieSky sky(type, Towards(30.0, sun));
      EXPECT_NEAR(sky.RelativeLuminance(kZenith), 1.0, 1e-12);
      for (double elevation = 0.0; elevation <= 90.0; elevation += 5.0) {
        for (double azimuth = 0.0; azimuth < 360.0; azimuth += 15.0) {
          const double luminance = sky.RelativeLuminance(Towards(azimuth, elevation));
          ASSERT_GT(luminance, 0.0);
          ASSERT_LT(luminance, 1e4);
        }
      }
      EXPECT_EQ(sky.RelativeLuminance(Towards(0.0, -1.0)), 0.0);
    }
  }
}

TEST(CieModel, IsScaledByTheLuminanceOfTheZenith) {
  SkyConditions conditions;
  conditions.zenith_luminance = CandelaPerM2(5'000.0);
  const auto sky = CreateSkyModel({SkyModelKind::kCie, 12}, conditions, Towards(180.0, 30.0));
  ASSERT_TRUE(sky.has_value());
  EXPECT_NEAR((*sky)->At(kZenith).luminance, 5'000.0, 1e-6);
  EXPECT_NEAR(Luminance((*sky)->SkyHorizontalIrradiance()), 5'000.0 / .1564, 40.0);
}

TEST(CieModel, IsScaledByTheIlluminanceOfLevelGround) {
  SkyConditions conditions;
  conditions.sky_horizontal_illuminance = Lux(10'000.0);
  for (int type = 1; type <= 15; ++type) {
    const auto sky = CreateSkyModel({SkyModelKind::kCie, type}, conditions, Towards(180.0, 30.0));
    ASSERT_TRUE(sky.has_value());
    EXPECT_NEAR(Luminance((*sky)->SkyHorizontalIrradiance()), 10'000.0, 1e-6);
    const double integral = IntegrateProjectedDome<256, 512>(
        [&](Direction<World> from) { return (*sky)->At(from).luminance; });
    EXPECT_NEAR(integral, 10'000.0, 1.5);
  }
}

// IES RP-21: overcast 0.3 + 21 sin a, partly cloudy 0.3 + 45 sin a, clear 0.8 + 15.5 √(sin a) klx.
TEST(CieModel, HasIesIlluminancesWithoutAScale) {
  for (const auto& [type, klx] : {std::pair{1, 10.8}, {7, 22.8}, {12, 11.76}}) {
    const auto sky = CreateSkyModel({SkyModelKind::kCie, type}, {}, Towards(180.0, 30.0));
    ASSERT_TRUE(sky.has_value());
    EXPECT_NEAR(Luminance((*sky)->SkyHorizontalIrradiance()) * 1e-3, klx, 0.01) << type;
  }
}

}  // namespace
}  // namespace pleinair::sky
