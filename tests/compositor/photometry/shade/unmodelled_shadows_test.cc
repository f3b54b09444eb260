// Tests the estimates of unmodelled shadows on images with known light.
#include "compositor/photometry/shade/unmodelled_shadows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compositor/light/sun_transmittance_map.h"
#include "compositor/photometry/heading_from_shadows.h"
#include "compositor/photometry/shade/ratio_from_shade.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "tests/compositor/photometry/shade_scenes.h"
#include "tests/compositor/photometry/shadow_light_yard.h"

namespace pleinair::compositor {
namespace {

using testing::PhotographedYard;
using testing::ShadowLight;
constexpr Vec3 kUp{0, 0, 1};

constexpr scene::MarkerReflectance kMarker{
    .size_m = 0.2, .board_size_m = 0.25, .black_band_m = 0.02};
UnmodelledShadows Shade(const SurfaceSamples& samples, const sky::SkyModel& model,
                        const PhantomRays& phantoms) {
  const MarkerLightMeter meter(kMarker, phantoms, model, Mat3{});
  return FindUnmodelledShadows(phantoms, samples, meter, model, Mat3{}, {1, 1, 1});
}

TEST_F(ShadowLight, DoubtsAnOvercastSkyWhereATreeShadesAllThePhantomsEdges) {
  const PhantomRays& phantoms = yard_->phantoms();
  const SurfaceSamples samples =
      Look({.shaded = [](Vec3 p) { return yard_->IsBesideShadowEdge(p); }});
  EXPECT_EQ(Read(samples).sun, SunSkyRatio::Sun::kHidden);
  const UnmodelledShadows unmodelled = Shade(samples, yard_->model(), phantoms);
  EXPECT_TRUE(unmodelled.CastBySun()) << unmodelled.boundary_cells << " of " << unmodelled.places;
  EXPECT_TRUE(unmodelled.HidesEdges())
      << unmodelled.sunny_sides.shaded << " of " << unmodelled.sunny_sides.places;
}

TEST_F(ShadowLight, EstimatesTheSkyBesideTheSunFromHowDeepTheShadeOfTreesIs) {
  const auto tree = [](Vec3 p) { return std::sin(9 * p.x) * std::sin(11 * p.y + 3 * p.z) > 0.0; };
  for (const double truth : {1.0, 1.7, 2.5}) {
    const SurfaceSamples samples =
        Look({.sky_radiance_scale = LinearRgb{1, 1, 1} * truth, .shaded = tree});
    const UnmodelledShadows unmodelled = Shade(samples, yard_->model(), yard_->phantoms());
    const SunSkyRatio estimate =
        EstimateRatioFromShade(yard_->phantoms(), unmodelled, yard_->model(), Mat3{});
    ASSERT_EQ(estimate.sun, SunSkyRatio::Sun::kShines);
    for (const double scale : {estimate.sky_radiance_scale.r, estimate.sky_radiance_scale.g,
                               estimate.sky_radiance_scale.b}) {
      EXPECT_NEAR(scale / truth, 1.0, 0.25) << truth;
    }
    EXPECT_LT(std::fabs(std::log(estimate.sky_radiance_scale.g / truth)),
              2 * estimate.log_uncertainty);
    EXPECT_GT(estimate.log_uncertainty, 0.2) << "it is no phantom's edge";
  }
  // Without trees there is no sun-to-sky ratio to estimate.
  const UnmodelledShadows open = Shade(Look({}), yard_->model(), yard_->phantoms());
  EXPECT_FALSE(open.IsWide());
  EXPECT_EQ(EstimateRatioFromShade(yard_->phantoms(), open, yard_->model(), Mat3{}).sun,
            SunSkyRatio::Sun::kUnknown);
}

TEST_F(ShadowLight, DoubtsAnOvercastSkyWhereTheTimeIsHoursOff) {
  const SurfaceSamples samples = Look({});
  const Vec3 to_sun = yard_->model().ToSun().xyz;
  int hidden = 0;
  for (const double off_deg : {-75.0, -50.0, 50.0, 75.0}) {
    const testing::UniformDay wrong({3000, 4200, 6500}, {62e3, 55e3, 44e3},
                                    Turned(to_sun, kUp, FromDegrees(off_deg)));
    const SunSkyRatio estimate =
        EstimateSunSkyRatio(FindShadowEdges(yard_->phantoms(), samples, wrong, Mat3{}));
    EXPECT_NE(estimate.sun, SunSkyRatio::Sun::kShines) << off_deg;
    hidden += estimate.sun == SunSkyRatio::Sun::kHidden ? 1 : 0;
    const UnmodelledShadows unmodelled = Shade(samples, wrong, yard_->phantoms());
    EXPECT_TRUE(unmodelled.CastBySun())
        << off_deg << ": " << unmodelled.boundary_cells << " of " << unmodelled.places;
    EXPECT_FALSE(unmodelled.HidesEdges()) << off_deg << ": " << unmodelled.sunny_sides.shaded;
  }
  EXPECT_GT(hidden, 0) << "without a doubt it would be taken for overcast";
}

TEST_F(ShadowLight, DoesNotDoubtAnOvercastSkyOverPatternedPaving) {
  for (const double strength : {1.0, 3.0}) {
    const SurfaceSamples samples =
        Look({.sky_radiance_scale = LinearRgb{1, 1, 1} * strength, .sun_scale = 0.0}, 3);
    EXPECT_EQ(Read(samples).sun, SunSkyRatio::Sun::kHidden);
    const UnmodelledShadows unmodelled = Shade(samples, yard_->model(), yard_->phantoms());
    EXPECT_GT(unmodelled.places, 100);
    EXPECT_FALSE(unmodelled.CastBySun())
        << unmodelled.boundary_cells << " of " << unmodelled.places;
  }
}

TEST_F(ShadowLight, EstimatesHowMuchLiesInTheShadeOfTrees) {
  const UnmodelledShadows open = Shade(Look({}), yard_->model(), yard_->phantoms());
  EXPECT_FALSE(open.IsWide());
  EXPECT_GT(open.sunlit, 100);
  EXPECT_FALSE(open.Matters()) << open.shaded;
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  const SurfaceSamples samples = Look({.shaded = tree});
  const UnmodelledShadows unmodelled = Shade(samples, yard_->model(), yard_->phantoms());
  EXPECT_TRUE(unmodelled.Matters());
  // The true share: surface samples under the tree among those sunlit in the model.
  int lit = 0, under = 0;
  for (const SurfaceSample& surface_sample : samples.samples()) {
    const Vec3 to_sun = yard_->model().ToSun().xyz;
    if (surface_sample.frames == 0 || surface_sample.surface < 0 ||
        Dot(surface_sample.normal, to_sun) < 0.2)
      continue;
    if (!yard_->phantoms().IsUnoccluded(surface_sample.point, to_sun)) continue;
    ++lit;
    under += tree(surface_sample.point.xyz) ? 1 : 0;
  }
  EXPECT_NEAR(unmodelled.shaded, static_cast<double>(under) / lit, 0.08);
}

TEST_F(ShadowLight, MapsWhereTheSunComesThroughTrees) {
  const UnmodelledShadows unmodelled =
      Shade(Look(testing::StripedShade(*yard_)), yard_->model(), yard_->phantoms());
  ASSERT_TRUE(unmodelled.Matters());
  testing::ExpectStripes(*yard_, unmodelled.sun_transmittance);
}

TEST_F(ShadowLight, MapsNoShadeWherePavingHasDarkJoints) {
  const UnmodelledShadows unmodelled =
      Shade(Look(testing::ShadeBesideJoints()), yard_->model(), yard_->phantoms());
  ASSERT_TRUE(unmodelled.Matters());
  testing::ExpectOpenJoints(*yard_, unmodelled.sun_transmittance);
}

TEST(SunTransmittanceMap, IsEmptyWhereAFewSamplesLieInOppositeCorners) {
  // The quantiles along either axis exclude one of them.
  const SunTransmittanceMap aim =
      BuildSunTransmittanceMap({0.3, 0.2, 1.0}, std::vector<SunlitSample>{{{}, 1, 0.1}});
  const std::vector<SunlitSample> surface_samples{{aim.across_y * 1.0, 0.3, 0.1},
                                                  {aim.across_x * 1.0, 1, 0.1}};
  const SunTransmittanceMap map = BuildSunTransmittanceMap({0.3, 0.2, 1.0}, surface_samples);
  EXPECT_TRUE(map.share.empty());
  EXPECT_EQ(map.At({}), 1.0);
}

TEST_F(ShadowLight, EstimatesFromTheGroundHowMuchDarkerThanTheSunTheMarkerIs) {
  // The frames' exposure scale comes from a marker in 0.7 of the sunlit light.
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  SurfaceSamples samples(yard_->phantoms(), yard_->camera(), yard_->marker());
  constexpr double kOnMarker = 0.7;
  const double exposure_scale = kOnMarker * PhotographedYard::kExposureScale;
  for (const int i : {0, 1}) {
    samples.AddFrame(yard_->Photograph(i, {.shaded = tree}).view(), PhotographedYard::Pose(i),
                     {exposure_scale, exposure_scale, exposure_scale});
  }
  const UnmodelledShadows unmodelled = Shade(samples, yard_->model(), yard_->phantoms());
  // The description's colors differ from the paving's.
  EXPECT_NEAR(unmodelled.sunlit_scale.ratio * kOnMarker, 1.0, 0.12);
  EXPECT_NEAR(unmodelled.on_marker.sun.g, yard_->model().SunNormalIrradiance().g * yard_->ToSun().z,
              1.0);
}

/// Samples of the yard with the exposure scale of a marker in a tree's shadow. It is too high by
/// the shadow's ratio.
SurfaceSamples FromAShadedMarker(const PhotographedYard& yard, PhotographedYard::Light light,
                                 double* true_exposure_scale) {
  light.colors_as_described = true;
  SurfaceSamples samples(yard.phantoms(), yard.camera(), yard.marker());
  const double sun = yard.model().SunNormalIrradiance().g * yard.ToSun().z;
  const double sky = yard.model().SkyHorizontalIrradiance().g;
  *true_exposure_scale = (sun + sky) / sky;
  const double exposure_scale = PhotographedYard::kExposureScale / *true_exposure_scale;
  for (const int i : {0, 1}) {
    samples.AddFrame(yard.Photograph(i, light).view(), PhotographedYard::Pose(i),
                     {exposure_scale, exposure_scale, exposure_scale});
  }
  return samples;
}

TEST_F(ShadowLight, EstimatesByOtherSurfacesThatPrintAndGroundLieInShadeAsAWhole) {
  // The ground offers no comparison; part of what stands on it is sunlit.
  double true_exposure_scale = 0.0;
  const SurfaceSamples samples = FromAShadedMarker(
      *yard_, {.shaded = [](Vec3 p) { return p.z < 0.02 || p.x < -0.5; }}, &true_exposure_scale);
  const UnmodelledShadows unmodelled = Shade(samples, yard_->model(), yard_->phantoms());
  EXPECT_NEAR(unmodelled.sunlit_scale.ratio / true_exposure_scale, 1.0, 0.15);
  EXPECT_TRUE(unmodelled.sunlit_scale.agreed);
  EXPECT_GT(unmodelled.shaded, 0.7);
  EXPECT_TRUE(unmodelled.IsWide());
  ASSERT_FALSE(unmodelled.sun_transmittance.share.empty());
  EXPECT_LT(unmodelled.sun_transmittance.At({0.2, -0.3, 0.0}), 0.2) << "beside the print";
  // The depth of the shadow determines the sky's strength without any visible edge.
  UnmodelledShadows edgeless = unmodelled;
  edgeless.crossings.clear();
  const SunSkyRatio estimate =
      EstimateRatioFromShade(yard_->phantoms(), edgeless, yard_->model(), Mat3{});
  ASSERT_EQ(estimate.sun, SunSkyRatio::Sun::kShines);
  EXPECT_NEAR(estimate.sky_radiance_scale.g, 1.0, 0.25);
  EXPECT_NEAR(estimate.sky_radiance_scale.b / estimate.sky_radiance_scale.r, 1.0, 0.15)
      << "it has the model's colour";
}

TEST_F(ShadowLight, BelievesTheMarkerWhereTheGroundShowsSunAndShade) {
  // Half the ground lies in a tree's shadow, the marker does not. The bricks are brighter than
  // described.
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  SurfaceSamples samples(yard_->phantoms(), yard_->camera(), yard_->marker());
  for (const int i : {0, 1}) {
    samples.AddFrame(yard_->Photograph(i, {.shaded = tree}).view(), PhotographedYard::Pose(i),
                     LinearRgb{1, 1, 1} * PhotographedYard::kExposureScale);
  }
  EXPECT_NEAR(Shade(samples, yard_->model(), yard_->phantoms()).sunlit_scale.ratio, 1.0, 0.15);
}

TEST_F(ShadowLight, BelievesSurfacesOfTwoColorsOfWhichOneIsStatedTooDark) {
  // The marker receives 0.57 of the sunlit light. Objects on the ground are brighter than
  // described, so they imply a larger correction than the ground. The ground's sun and shadow
  // contradict it. Both imply that the marker is too dark.
  constexpr double kOnMarker = 0.57, kBrighter = 1.4;
  SurfaceSamples samples(yard_->phantoms(), yard_->camera(), yard_->marker());
  for (const int i : {0, 1}) {
    const RgbImage picture = yard_->Photograph(
        i, {.shaded = [](Vec3 p) { return p.z < 0.02 ? p.x + p.y < -0.2 : p.x > 0.3; },
            .colors_as_described = true,
            .brighter = [](Vec3 p) { return p.z > 0.02 ? kBrighter : 1.0; }});
    samples.AddFrame(picture.view(), PhotographedYard::Pose(i),
                     LinearRgb{1, 1, 1} * (kOnMarker * PhotographedYard::kExposureScale));
  }
  const UnmodelledShadows unmodelled = Shade(samples, yard_->model(), yard_->phantoms());
  EXPECT_TRUE(unmodelled.ShadesMarker());
  EXPECT_GT(unmodelled.sunlit_scale.ratio * kOnMarker, 0.95);
  EXPECT_LT(unmodelled.sunlit_scale.ratio * kOnMarker, kBrighter - 0.05);
}

TEST_F(ShadowLight, SeesBesideTheMarkerThatItLiesInTheGroundsShade) {
  // The ground's bright part is half-lit. It looks as bright as sunlit ground would if the marker
  // were sunlit. Alone it would suggest a partly sunlit marker; the fully sunlit wall contradicts
  // it.
  double true_exposure_scale = 0.0;
  const auto half_light = [](Vec3 p) { return p.z < 0.02 && p.x > 0.45 ? 2.2 : 1.0; };
  const SurfaceSamples samples = FromAShadedMarker(
      *yard_, {.shaded = [](Vec3 p) { return p.y < 1.15; }, .brighter = half_light},
      &true_exposure_scale);
  const UnmodelledShadows unmodelled = Shade(samples, yard_->model(), yard_->phantoms());
  EXPECT_TRUE(unmodelled.sunlit_scale.shown_by_surroundings);
  EXPECT_TRUE(unmodelled.ShadesMarker());
  EXPECT_NEAR(unmodelled.sunlit_scale.ratio / true_exposure_scale, 1.0, 0.15);
}

TEST_F(ShadowLight, TakesADarkMatBeneathTheMarkerForNoShade) {
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  const auto mat = [](Vec3 p) {
    const double beside = std::max(std::fabs(p.x), std::fabs(p.y));
    return beside > 0.125 && beside < 0.4 && p.z < 0.02 ? 0.3 : 1.0;
  };
  SurfaceSamples samples(yard_->phantoms(), yard_->camera(), yard_->marker());
  for (const int i : {0, 1}) {
    samples.AddFrame(
        yard_->Photograph(i, {.shaded = tree, .colors_as_described = true, .brighter = mat}).view(),
        PhotographedYard::Pose(i), LinearRgb{1, 1, 1} * PhotographedYard::kExposureScale);
  }
  const UnmodelledShadows unmodelled = Shade(samples, yard_->model(), yard_->phantoms());
  ASSERT_TRUE(unmodelled.Matters());
  EXPECT_FALSE(unmodelled.sunlit_scale.shown_by_surroundings);
  EXPECT_FALSE(unmodelled.ShadesMarker());
}

TEST_F(ShadowLight, TakesAPatternBesideTheMarkerForNoShadeUnderAFaintSun) {
  // Paving a fifth darker around the marker looks as dark as a shadow under this sun.
  constexpr double kFaint = 0.08;
  const ScaledSky faint(yard_->model(), {1, 1, 1}, {kFaint, kFaint, kFaint});
  const auto darker = [](Vec3 p) {
    const double beside = std::max(std::fabs(p.x), std::fabs(p.y));
    return beside > 0.125 && beside < 0.4 && p.z < 0.02 ? 0.82 : 1.0;
  };
  SurfaceSamples samples(yard_->phantoms(), yard_->camera(), yard_->marker());
  for (const int i : {0, 1}) {
    samples.AddFrame(
        yard_->Photograph(i, {.sun_scale = kFaint, .colors_as_described = true, .brighter = darker})
            .view(),
        PhotographedYard::Pose(i), LinearRgb{1, 1, 1} * PhotographedYard::kExposureScale);
  }
  const MarkerLightMeter meter(kMarker, yard_->phantoms(), faint, Mat3{});
  const UnmodelledShadows unmodelled =
      FindUnmodelledShadows(yard_->phantoms(), samples, meter, faint, Mat3{}, {1, 1, 1});
  ASSERT_TRUE(unmodelled.Matters());
  EXPECT_FALSE(unmodelled.sunlit_scale.shown_by_surroundings);
  EXPECT_FALSE(unmodelled.ShadesMarker());
}

TEST(UnmodelledShadows, EstimatesHowMuchDarkerThanTheSunAMarkerOnAWallIs) {
  // The paving is a wall and the objects on it are awnings. The sky is as bright as the sun's
  // light, and a wall sees half of it.
  const Mat3 on_wall{{1, 0, 0, 0, 0, 1, 0, -1, 0}};
  const PhotographedYard yard({-0.5, 0.6, 0.62}, {10e3, 12e3, 14e3}, on_wall);
  const MarkerLightMeter meter(yard.marker(), yard.phantoms(), yard.model(), on_wall);
  ASSERT_TRUE(meter.in_sun());
  SurfaceSamples samples(yard.phantoms(), yard.camera(), yard.marker());
  constexpr double kOnMarker = 0.7;
  const double exposure_scale = kOnMarker * PhotographedYard::kExposureScale;
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  for (const int i : {0, 1}) {
    samples.AddFrame(yard.Photograph(i, {.shaded = tree}).view(), PhotographedYard::Pose(i),
                     {exposure_scale, exposure_scale, exposure_scale});
  }
  const UnmodelledShadows unmodelled =
      FindUnmodelledShadows(yard.phantoms(), samples, meter, yard.model(), on_wall, {1, 1, 1});
  ASSERT_TRUE(unmodelled.Matters());
  EXPECT_NEAR(unmodelled.sunlit_scale.ratio * kOnMarker, 1.0, 0.12);
  const LinearRgb level = yard.model().SkyHorizontalIrradiance();
  EXPECT_LT(unmodelled.on_marker.ambient.g, 0.8 * level.g)
      << "half the sky, and what the land sends back";
  EXPECT_GT(unmodelled.on_marker.ambient.g, 0.4 * level.g);
}

}  // namespace
}  // namespace pleinair::compositor
