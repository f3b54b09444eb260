#include "sky/cloud_cover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "sky/cie_sky.h"
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

std::unique_ptr<SkyModel> Sky(double cover, double elevation_deg,
                              SkyModelKind kind = SkyModelKind::kPerez) {
  SkyConditions conditions;
  conditions.cloud_cover = cover;
  return *CreateSkyModel({kind, 0}, conditions, Towards(150.0, elevation_deg));
}

struct Light {
  double sun, sky, global, share;
};
Light Measure(double cover, double elevation_deg) {
  const auto model = Sky(cover, elevation_deg);
  const double sun = Luminance(model->SunNormalIrradiance());
  const double sky = Luminance(model->SkyHorizontalIrradiance());
  const double global = sky + sun * std::max(0.0, model->ToSun().xyz.z);
  return {sun, sky, global, sky / global};
}

// Kasten & Czeplak 1980, Eq. (2): 1 − 0.75 (N/8)^3.4.
TEST(CloudCover, LeavesWhatKastenAndCzeplakMeasured) {
  const double clear = Measure(0.0, 30.0).global;
  for (const auto& [eighths, share] :
       {std::pair{2, 0.9933}, {4, 0.9290}, {6, 0.7180}, {7, 0.5237}, {8, 0.25}}) {
    EXPECT_NEAR(Measure(eighths / 8.0, 30.0).global / clear, share, 1e-3) << eighths;
  }
}

// Eq. (4): diffuse share 0.3 + 0.7 (N/8)².
TEST(CloudCover, HasTheDiffuseShareOfKastenAndCzeplak) {
  SkyConditions conditions;
  for (double cover = 0.25; cover <= 1.0; cover += 0.125) {
    conditions.cloud_cover = cover;
    const auto sky = CreateSkyModel({SkyModelKind::kAtmosphere, 0}, conditions, Towards(150, 30));
    ASSERT_TRUE(sky.has_value());
    const double diffuse = Luminance((*sky)->SkyHorizontalIrradiance());
    const double direct = Luminance((*sky)->SunNormalIrradiance()) * 0.5;
    EXPECT_NEAR(diffuse / (diffuse + direct), 0.3 + 0.7 * cover * cover, 0.08) << cover;
  }
}

TEST(CloudCover, DimsSunAndGroundAndDiffusesWithoutAStep) {
  for (const double elevation : {2.0, 12.0, 45.0, 80.0}) {
    Light last = Measure(0.0, elevation);
    for (double cover = 0.005; cover < 1.0001; cover += 0.005) {
      const Light now = Measure(std::min(cover, 1.0), elevation);
      ASSERT_LE(now.sun, last.sun) << cover;
      ASSERT_LE(now.global, last.global * (1.0 + 1e-12)) << cover;
      ASSERT_GE(now.share, last.share * (1.0 - 1e-12)) << cover;
      ASSERT_NEAR(now.global, last.global, 0.055 * last.global) << cover;
      ASSERT_NEAR(now.sky, last.sky, 0.09 * last.sky) << cover << " " << elevation;
      last = now;
    }
    EXPECT_EQ(last.sun, 0.0);
    EXPECT_NEAR(last.share, 1.0, 1e-12);
  }
}

TEST(CloudCover, ChangesEachDirectionWithoutAStep) {
  const Direction<World> directions[] = {Towards(150, 31), Towards(330, 10), Towards(60, 70)};
  for (const Direction<World>& from : directions) {
    double last = Sky(0.0, 30.0)->At(from).luminance;
    for (double cover = 0.005; cover < 1.0001; cover += 0.005) {
      const double now = Sky(std::min(cover, 1.0), 30.0)->At(from).luminance;
      ASSERT_NEAR(now, last, 0.1 * last) << cover;
      last = now;
    }
  }
}

TEST(CloudCover, OfNothingIsTheClearSky) {
  const auto clear = Sky(0.0, 30.0), veiled = Sky(1e-9, 30.0);
  for (const double elevation : {1.0, 30.0, 80.0}) {
    EXPECT_NEAR(veiled->At(Towards(150.0, elevation)).luminance,
                clear->At(Towards(150.0, elevation)).luminance, 1e-2);
  }
  EXPECT_NEAR(Luminance(veiled->SunNormalIrradiance()), Luminance(clear->SunNormalIrradiance()),
              1e-3);
}

TEST(CloudCover, OfAllIsTheCieOvercastSky) {
  const auto sky = Sky(1.0, 30.0);
  const CieSky cie(1, Towards(150.0, 30.0));
  const double zenith = sky->At(Towards(0.0, 90.0)).luminance;
  EXPECT_NEAR(Luminance(sky->SkyHorizontalIrradiance()) / zenith, 1.0 / 0.4082, 2e-3);
  for (const double elevation : {0.0, 20.0, 60.0}) {
    EXPECT_NEAR(sky->At(Towards(10.0, elevation)).luminance / zenith,
                cie.RelativeLuminance(Towards(10.0, elevation)), 1e-9);
  }
  const XyY color = sky->At(Towards(10.0, 20.0));
  EXPECT_NEAR(color.x, 0.3127, 2e-4);
  EXPECT_NEAR(color.y, 0.3290, 2e-4);
}

TEST(CloudCover, IntegratesToItsHorizontalIlluminance) {
  for (const SkyModelKind kind : {SkyModelKind::kPerez, SkyModelKind::kAtmosphere}) {
    const auto sky = Sky(0.45, 25.0, kind);
    const double integral =
        IntegrateProjectedDome([&](Direction<World> from) { return sky->At(from).luminance; });
    EXPECT_NEAR(integral / Luminance(sky->SkyHorizontalIrradiance()), 1.0, 3e-4);
  }
}

TEST(CloudCover, DimsTheVeilOfTheAir) {
  const auto clear = Sky(0.0, 30.0, SkyModelKind::kAtmosphere);
  const auto overcast = Sky(1.0, 30.0, SkyModelKind::kAtmosphere);
  const auto there = Towards(0.0, 0.0);
  EXPECT_EQ(clear->AirTo(there, Metres(5'000.0)).transmittance,
            overcast->AirTo(there, Metres(5'000.0)).transmittance);
  EXPECT_NEAR(Luminance(overcast->AirTo(there, Metres(5'000.0)).inscattered) /
                  Luminance(clear->AirTo(there, Metres(5'000.0)).inscattered),
              0.25, 1e-9);
}

}  // namespace
}  // namespace pleinair::sky
