// Tests what the fit makes of images with known light.
#include "compositor/photometry/estimate/light_posterior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compositor/photometry/heading_from_shadows.h"
#include "tests/compositor/gentle_response.h"
#include "tests/compositor/photometry/estimate/fitted_yard.h"

namespace pleinair::compositor {
namespace {

using testing::FittedYard;
using testing::PhotographedYard;
constexpr double kSure = 0.95;
constexpr Vec3 kUp{0, 0, 1};

void ExpectScale(const LightPosterior& light, LinearRgb truth, double tolerance = 0.1) {
  EXPECT_GT(light.sun, kSure);
  EXPECT_NEAR(light.log_sky[0], std::log(truth.r), tolerance);
  EXPECT_NEAR(light.log_sky[1], std::log(truth.g), tolerance);
  EXPECT_NEAR(light.log_sky[2], std::log(truth.b), tolerance);
  // The error must agree with the reported uncertainty.
  EXPECT_LT(std::fabs(light.log_sky[1] - std::log(truth.g)), 3 * light.log_sky_error);
}

TEST_F(FittedYard, EstimatesHowStrongTheSkyIsBesideTheSun) {
  for (const double scale : {0.6, 1.0, 2.5}) {
    const LinearRgb sky{scale, scale, scale};
    const LightPosterior light = Fit(Look({.sky_radiance_scale = sky})).light;
    ExpectScale(light, sky);
    EXPECT_LT(light.log_sky_error, 0.15);
    EXPECT_GT(light.counted.edges_agreeing, 10);
    EXPECT_LT(light.shaded, 0.02);
  }
}

TEST_F(FittedYard, EstimatesTheColorOfTheSkyBesideTheSuns) {
  // Shrunk towards the model's color.
  ExpectScale(Fit(Look({.sky_radiance_scale = {0.8, 1.0, 1.4}})).light, {0.8, 1.0, 1.4}, 0.2);
}

TEST_F(FittedYard, SeesThatNoSunShinesAlsoOverPatternedPaving) {
  for (const double strength : {1.0, 3.0}) {
    const LightPosterior light =
        Fit(Look({.sky_radiance_scale = LinearRgb{1, 1, 1} * strength, .sun_scale = 0.0})).light;
    EXPECT_GT(light.clouds, kSure) << strength;
  }
}

TEST_F(FittedYard, SeesAFaintSunThroughThickHaze) {
  ExpectScale(Fit(Look({.sky_radiance_scale = {5, 5, 5}})).light, {5, 5, 5}, 0.2);
}

TEST_F(FittedYard, LeavesOutPlacesInTheShadowOfATreeThatNoPhantomStandsFor) {
  const auto tree = [](Vec3 p) {
    // Half the yard, in patches.
    return p.x < 0.0 && std::sin(9 * p.x) * std::sin(11 * p.y + 3 * p.z) > -0.6;
  };
  ExpectScale(Fit(Look({.shaded = tree}, 3)).light, {1, 1, 1}, 0.25);
}

TEST_F(FittedYard, IsNotMisledByChangingExposure) {
  ExpectScale(Fit(Look({}, 2, 0.7)).light, {1, 1, 1});
}

TEST_F(FittedYard, ReadsCodesByTheCamerasOwnResponse) {
  const CameraResponse gentle = testing::GentleResponse();
  const auto read_as = [&](const CameraResponse& response) {
    SurfaceSamples samples(yard_->phantoms(), yard_->camera(), yard_->marker(), response);
    for (const int i : {0, 1}) {
      samples.AddFrame(yard_->Photograph(i, {}, gentle).view(), PhotographedYard::Pose(i),
                       {1, 1, 1});
    }
    return Fit(samples).light;
  };
  ExpectScale(read_as(gentle), {1, 1, 1});
  // Decoded as sRGB, whose values imply more contrast, the shadow seems too deep for this sky.
  EXPECT_LT(read_as({}).log_sky[1], std::log(0.9));
}

TEST_F(FittedYard, CountsNoEdgeWhereNoPhantomCastsAShadow) {
  const auto bare =
      LightSolver::Create({testing::Phantom(testing::Ground(5.0, {0.3F, 0.3F, 0.3F}))}, {});
  ASSERT_TRUE(bare);
  SurfaceSamples samples((*bare)->phantoms(), yard_->camera(), yard_->marker());
  samples.AddFrame(yard_->Photograph(0, {}).view(), PhotographedYard::Pose(0), {1, 1, 1});
  const LightPosterior light = Fit(samples, (*bare)->phantoms(), yard_->model()).light;
  EXPECT_EQ(light.counted.edges, 0);
}

TEST_F(FittedYard, DoubtsAnOvercastSkyWhereATreeShadesAllThePhantomsEdges) {
  const auto tree = [](Vec3 p) { return yard_->IsBesideShadowEdge(p); };
  EXPECT_LT(Fit(Look({.shaded = tree})).light.clouds, 1 - kSure);
}

TEST_F(FittedYard, EstimatesTheSkyBesideTheSunFromHowDeepTheShadeOfTreesIs) {
  const auto tree = [](Vec3 p) { return std::sin(9 * p.x) * std::sin(11 * p.y + 3 * p.z) > 0.0; };
  for (const double truth : {1.0, 1.7, 2.5}) {
    const LinearRgb sky{truth, truth, truth};
    ExpectScale(Fit(Look({.sky_radiance_scale = sky, .shaded = tree})).light, sky, 0.25);
  }
}

TEST_F(FittedYard, BelievesNeitherSunNorCloudsWhereTheTimeIsHoursOff) {
  const SurfaceSamples samples = Look({});
  for (const double off_deg : {-75.0, -50.0, 50.0, 75.0}) {
    const testing::UniformDay wrong({3000, 4200, 6500}, {62e3, 55e3, 44e3},
                                    Turned(yard_->model().ToSun().xyz, kUp, FromDegrees(off_deg)));
    const LightPosterior light = Fit(samples, yard_->phantoms(), wrong).light;
    EXPECT_GT(light.elsewhere, 0.9) << off_deg << ": sun " << light.sun;
  }
}

TEST_F(FittedYard, EstimatesHowMuchLiesInTheShadeOfTrees) {
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  const SurfaceSamples samples = Look({.shaded = tree});
  // The true share: surface samples under the tree among those sunlit in the model.
  int lit = 0, under = 0;
  for (const SurfaceSample& sample : samples.samples()) {
    const Vec3 to_sun = yard_->ToSun();
    if (sample.frames == 0 || sample.surface < 0 || Dot(sample.normal, to_sun) < 0.2) continue;
    if (!yard_->phantoms().IsUnoccluded(sample.point, to_sun)) continue;
    ++lit;
    under += tree(sample.point.xyz) ? 1 : 0;
  }
  EXPECT_NEAR(Fit(samples).light.shaded, static_cast<double>(under) / lit, 0.1);
}

/// A marker with ten times as much sun as sky.
MarkerLight Marker() {
  return {.predicted = {11, 11, 11}, .from = {{1, 1, 1}, {}, {1, 1, 1}}, .sun = {10, 10, 10}};
}

TEST(MarkerExposure, BindsTheExposureScaleAndTellsShade) {
  const MarkerLight marker = Marker();
  const MarkerExposure open(marker, {1, 1, 1}, marker.sun, 0.01);
  EXPECT_EQ(open.LogShade(0.0), 0.0);
  const LevelFunction prior = open.LogPrior();
  EXPECT_NEAR(LogSum(prior), 0.0, 0.02) << "it is a density";
  const auto best = std::max_element(prior.begin(), prior.end()) - prior.begin();
  EXPECT_NEAR(LevelGrid::At(static_cast<int>(best)), 0.0, LevelGrid::kStep);
  // Without any sun, the unit of the samples is eleven times too bright.
  EXPECT_NEAR(open.LogShade(std::log(11.0)), std::log(11.0), 1e-9);
  EXPECT_EQ(MarkerExposure({}, {1, 1, 1}, {}, 0.5).LogShade(1.0), 0.0) << "no marker";
}

TEST(MarkerExposure, TakesDapplesForShade) {
  MarkerLight marker = Marker();
  const double part = std::log(11.0 / 8.0);
  const MarkerExposure even(marker, {1, 1, 1}, marker.sun, 0.3);
  marker.dappled = true;
  const MarkerExposure dappled(marker, {1, 1, 1}, marker.sun, 0.3);
  const int at = static_cast<int>(std::lround(-LevelGrid::kFirst / LevelGrid::kStep));
  EXPECT_LT(dappled.LogPrior()[at], even.LogPrior()[at]);
  EXPECT_NEAR(dappled.LogShade(part), part, 1e-9);
}

}  // namespace
}  // namespace pleinair::compositor
