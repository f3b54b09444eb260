// Tests the estimates from the phantoms' own shadows on images with known light.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "compositor/photometry/heading_from_shadows.h"
#include "compositor/photometry/marker/marker_shadow_edge.h"
#include "compositor/photometry/overcast_test.h"
#include "compositor/photometry/sun_elsewhere.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "tests/compositor/gentle_response.h"
#include "tests/compositor/photometry/shadow_light_yard.h"

namespace pleinair::compositor {
namespace {

using testing::PhotographedYard;
using testing::ShadowLight;
constexpr Vec3 kUp{0, 0, 1};

void ExpectScale(const SunSkyRatio& estimate, LinearRgb truth) {
  ASSERT_EQ(estimate.sun, SunSkyRatio::Sun::kShines);
  EXPECT_NEAR(estimate.sky_radiance_scale.r / truth.r, 1.0, 0.1);
  EXPECT_NEAR(estimate.sky_radiance_scale.g / truth.g, 1.0, 0.1);
  EXPECT_NEAR(estimate.sky_radiance_scale.b / truth.b, 1.0, 0.1);
  // The error must agree with the reported uncertainty.
  EXPECT_LT(std::fabs(std::log(estimate.sky_radiance_scale.g / truth.g)),
            3 * estimate.log_uncertainty);
  EXPECT_LT(estimate.log_uncertainty, 0.15);
}

TEST_F(ShadowLight, EstimatesHowStrongTheSkyIsBesideTheSun) {
  for (const double scale : {0.6, 1.0, 2.5}) {
    ExpectScale(Read(Look({.sky_radiance_scale = {scale, scale, scale}})), {scale, scale, scale});
  }
}

TEST_F(ShadowLight, EstimatesTheColorOfTheSkyBesideTheSuns) {
  ExpectScale(Read(Look({.sky_radiance_scale = {0.8, 1.0, 1.4}})), {0.8, 1.0, 1.4});
}

TEST_F(ShadowLight, SeesThatNoSunShines) {
  const SunSkyRatio estimate = Read(Look({.sky_radiance_scale = {3, 3, 3}, .sun_scale = 0.0}));
  EXPECT_EQ(estimate.sun, SunSkyRatio::Sun::kHidden);
  EXPECT_GE(estimate.edges, 6);
}

TEST_F(ShadowLight, SeesAFaintSunThroughThickHaze) {
  const SunSkyRatio estimate = Read(Look({.sky_radiance_scale = {5, 5, 5}}));
  ASSERT_EQ(estimate.sun, SunSkyRatio::Sun::kShines);
  EXPECT_NEAR(estimate.sky_radiance_scale.g, 5.0, 1.0);
}

TEST_F(ShadowLight, LeavesOutPlacesInTheShadowOfATreeThatNoPhantomStandsFor) {
  const auto tree = [](Vec3 p) {
    // Half the yard, in patches.
    return p.x < 0.0 && std::sin(9 * p.x) * std::sin(11 * p.y + 3 * p.z) > -0.6;
  };
  ExpectScale(Read(Look({.sky_radiance_scale = {1, 1, 1}, .shaded = tree}, 3)), {1, 1, 1});
}

TEST_F(ShadowLight, IsNotMisledByChangingExposure) {
  ExpectScale(Read(Look({}, 2, 0.7)), {1, 1, 1});
}

TEST_F(ShadowLight, ReadsCodesByTheCamerasOwnResponse) {
  const CameraResponse gentle = testing::GentleResponse();
  const auto read_as = [&](const CameraResponse& response) {
    SurfaceSamples samples(yard_->phantoms(), yard_->camera(), yard_->marker(), response);
    for (const int i : {0, 1}) {
      samples.AddFrame(yard_->Photograph(i, {}, gentle).view(), PhotographedYard::Pose(i),
                       {1, 1, 1});
    }
    return Read(samples);
  };
  ExpectScale(read_as(gentle), {1, 1, 1});
  // Decoded as sRGB, whose values imply more contrast, the shadow seems too deep for this sky.
  const SunSkyRatio wrong = read_as({});
  ASSERT_EQ(wrong.sun, SunSkyRatio::Sun::kShines);
  EXPECT_LT(wrong.sky_radiance_scale.g, 0.85);
}

TEST_F(ShadowLight, EstimatesTheSkyFromAShadowAcrossTheMarker) {
  const LinearRgb sun = yard_->model().SunNormalIrradiance() * Dot(kUp, yard_->ToSun());
  const Point<Marker> lit{{0.3, -0.3, 0.0}};
  // One shaded point lies before the wall, which occludes part of the sky; an unmodelled object
  // there hides another tenth. The other point lies behind the wall, in its shadow.
  const Point<Marker> before_wall{{0.1, 1.0, 0.0}}, behind_wall{{0.1, 1.8, 0.0}};
  MarkerShadowEdge shadow;
  for (const auto& [shaded, left] : {std::pair{before_wall, 0.9}, {behind_wall, 1.0}}) {
    shadow = {{}, lit, shaded};
    const auto ambient = [&](LinearRgb of_sky, LinearRgb of_sun) {
      return yard_->phantoms().Ambient(std::vector{shadow.lit, shadow.shaded}, kUp,
                                       ScaledSky(yard_->model(), of_sky, of_sun), Mat3{}, 2048);
    };
    for (const double truth : {0.5, 1.0, 3.0}) {
      const auto sky = ambient(LinearRgb{1, 1, 1} * truth, {}), reflected = ambient({}, {1, 1, 1});
      const LinearRgb ratio = (sky[0] + reflected[0] + sun) / (sky[1] * left + reflected[1]);
      shadow.contrast = {std::log(ratio.r), std::log(ratio.g), std::log(ratio.b)};
      const SunSkyRatio estimate = EstimateRatioFromMarkerShadow(
          yard_->phantoms(), std::vector{shadow, shadow}, yard_->model(), Mat3{});
      ASSERT_EQ(estimate.sun, SunSkyRatio::Sun::kShines);
      EXPECT_NEAR(estimate.sky_radiance_scale.r / truth, 1.0, 0.05);
      EXPECT_NEAR(estimate.sky_radiance_scale.g / truth, 1.0, 0.05);
      EXPECT_NEAR(estimate.sky_radiance_scale.b / truth, 1.0, 0.05);
      EXPECT_GT(estimate.log_uncertainty, 0.1);
    }
  }
  const auto unknown = [](const SunSkyRatio& estimate) {
    return estimate.sun == SunSkyRatio::Sun::kUnknown;
  };
  EXPECT_TRUE(
      unknown(EstimateRatioFromMarkerShadow(yard_->phantoms(), {}, yard_->model(), Mat3{})));
  shadow.contrast = {1.5, 1.5, 1.5};
  const testing::UniformDay low({3000, 4200, 6500}, {62e3, 55e3, 44e3}, {1.0, 0.0, 0.15});
  EXPECT_TRUE(
      unknown(EstimateRatioFromMarkerShadow(yard_->phantoms(), std::vector{shadow}, low, Mat3{})));
}

TEST_F(ShadowLight, ReportsNothingWhereNoPhantomCastsAShadowInView) {
  const auto bare =
      LightSolver::Create({testing::Phantom(testing::Ground(5.0, {0.3F, 0.3F, 0.3F}))}, {});
  ASSERT_TRUE(bare);
  const PhantomRays& phantoms = (*bare)->phantoms();
  SurfaceSamples samples(phantoms, yard_->camera(), yard_->marker());
  samples.AddFrame(yard_->Photograph(0, {}).view(), PhotographedYard::Pose(0), {1, 1, 1});
  EXPECT_EQ(EstimateSunSkyRatio(FindShadowEdges(phantoms, samples, yard_->model(), Mat3{})).sun,
            SunSkyRatio::Sun::kUnknown);
  EXPECT_FALSE(EstimateHeading(phantoms, samples, kUp, yard_->model().ToSun().xyz));
}

TEST_F(ShadowLight, FindsHowFarTheHeadingIsOff) {
  const SurfaceSamples samples = Look({});
  for (const double error_deg : {-7.0, -3.0, 0.0, 3.0}) {
    // The scene description has a heading that puts the sun this far off.
    const Vec3 stated = Turned(yard_->model().ToSun().xyz, kUp, FromDegrees(error_deg));
    const auto heading = EstimateHeading(yard_->phantoms(), samples, kUp, stated);
    ASSERT_TRUE(heading) << error_deg;
    EXPECT_NEAR(ToDegrees(heading->offset), -error_deg, 0.25);
    EXPECT_LT(ToDegrees(heading->uncertainty), 0.3);
  }
}

/// The sun's path of a day turns it by 15 degrees an hour about an axis tilted from the vertical.
StatedSun StatedAt(Vec3 to_sun) {
  return {kUp, to_sun, [to_sun](double seconds) {
            const Vec3 pole = Normalized({0.0, 0.64, 0.77});
            return Turned(to_sun, pole, FromDegrees(-15.0 * seconds / 3600.0));
          }};
}

TEST_F(ShadowLight, FindsTheHeadingThatPutsTheSunWhereShadowsFit) {
  const SurfaceSamples samples = Look({});
  for (const double error_deg : {-150.0, -40.0, -20.0, -10.5, 11.0, 20.0, 90.0, 180.0}) {
    const Vec3 stated = Turned(yard_->model().ToSun().xyz, kUp, FromDegrees(error_deg));
    const auto heading = EstimateHeading(yard_->phantoms(), samples, kUp, stated);
    EXPECT_FALSE(heading && IsConvincing(*heading)) << error_deg;
    const auto found = FindSunElsewhere(yard_->phantoms(), samples, StatedAt(stated));
    ASSERT_TRUE(found && found->heading_offset) << error_deg;
    EXPECT_NEAR(std::remainder(ToDegrees(*found->heading_offset) + error_deg, 360.0), 0.0, 0.5)
        << error_deg;
  }
}

TEST_F(ShadowLight, FindsTheTimeThatPutsTheSunWhereShadowsFit) {
  const SurfaceSamples samples = Look({});
  for (const double error_s : {-7200.0, -3600.0, 3600.0, 5400.0}) {
    const Vec3 stated = StatedAt(yard_->model().ToSun().xyz).to_sun_after(error_s);
    const auto found = FindSunElsewhere(yard_->phantoms(), samples, StatedAt(stated));
    ASSERT_TRUE(found && found->later_s) << error_s;
    EXPECT_NEAR(*found->later_s + error_s, 0.0, 180.0) << error_s;
    EXPECT_TRUE(found->time_fits_better) << error_s;
  }
}

TEST_F(ShadowLight, FindsNoSunElsewhereWhereItStandsRight) {
  const SurfaceSamples samples = Look({});
  for (const double error_deg : {-9.0, 0.0, 9.0}) {
    const Vec3 stated = Turned(yard_->model().ToSun().xyz, kUp, FromDegrees(error_deg));
    EXPECT_FALSE(FindSunElsewhere(yard_->phantoms(), samples, StatedAt(stated))) << error_deg;
  }
}

TEST_F(ShadowLight, BelievesTheStatedHeadingUnderAnOvercastSky) {
  const SurfaceSamples samples = Look({.sky_radiance_scale = {3, 3, 3}, .sun_scale = 0.0});
  EXPECT_FALSE(EstimateHeading(yard_->phantoms(), samples, kUp, yard_->model().ToSun().xyz));
  EXPECT_FALSE(FindSunElsewhere(yard_->phantoms(), samples, StatedAt(yard_->model().ToSun().xyz)));
}

TEST_F(ShadowLight, MakesPlanesOfOneMaterialDifferWhereverShadowsFall) {
  const auto contrast = [](const PhotographedYard& yard, const PhotographedYard::Light& light) {
    SurfaceSamples samples(yard.phantoms(), yard.camera(), yard.marker());
    for (const int i : {0, 1}) {
      samples.AddFrame(yard.Photograph(i, light).view(), PhotographedYard::Pose(i), {1, 1, 1});
    }
    // The overcast sky model has no sun.
    const testing::UniformDay overcast({3000, 4200, 6500}, {}, yard.model().ToSun().xyz);
    return TestForOvercast(yard.phantoms(), samples, overcast, Mat3{}).within;
  };
  const double veiled = contrast(*yard_, {.sky_radiance_scale = {3, 3, 3}, .sun_scale = 0.0});
  EXPECT_LT(veiled, 0.3);
  // This sun lights tops and visible sides almost equally. The contrast exceeds that without a sun,
  // but is too small to reject an overcast sky (compositor/photometry/light_estimator.cc: 0.6).
  EXPECT_GT(contrast(*yard_, {}), veiled + 0.2);
  EXPECT_LT(contrast(*yard_, {}), 0.6);
  // A sun high over the yard, or behind the visible surfaces, is detected.
  EXPECT_GT(contrast(PhotographedYard({-0.2, 0.3, 0.9}), {}), 0.6);
}

TEST_F(ShadowLight, MakesPlanesOfSeveralMaterialsDifferFromTheirStatedColors) {
  const PhotographedYard yard({-0.2, 0.3, 0.9});
  const testing::UniformDay overcast({3000, 4200, 6500}, {}, yard.model().ToSun().xyz);
  const auto among = [&](const PhotographedYard::Light& light, const sky::SkyModel& day) {
    SurfaceSamples samples(yard.phantoms(), yard.camera(), yard.marker());
    samples.AddFrame(yard.Photograph(0, light).view(), PhotographedYard::Pose(0), {1, 1, 1});
    const OvercastTest contrast = TestForOvercast(yard.phantoms(), samples, day, Mat3{});
    // Ground, wall, block and marker; upward, front and side faces.
    EXPECT_GE(contrast.surfaces, 4);
    EXPECT_GE(contrast.directions, 3);
    return contrast.among;
  };
  const PhotographedYard::Light veiled{
      .sky_radiance_scale = {3, 3, 3}, .sun_scale = 0.0, .colors_as_described = true};
  EXPECT_LT(among(veiled, overcast), 0.12);
  EXPECT_GT(among(veiled, yard.model()), 0.25);
  const PhotographedYard::Light sunny{.colors_as_described = true};
  EXPECT_LT(among(sunny, yard.model()), 0.12);
  EXPECT_GT(among(sunny, overcast), 0.25);
}

}  // namespace
}  // namespace pleinair::compositor
