// Tests what the fit makes of images with known light.
#include "compositor/photometry/estimate/light_posterior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "compositor/photometry/estimate/shade_field.h"
#include "compositor/photometry/estimate/shaded_levels.h"
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
  const MarkerExposure open(marker, {1, 1, 1}, marker.sun, 0.01, 0.0);
  EXPECT_EQ(open.LogShade(0.0), 0.0);
  LevelFunction prior;
  for (int i = 0; i < LevelGrid::kCount; ++i) prior[i] = open.LogPrior(LevelGrid::At(i));
  EXPECT_NEAR(LogSum(prior), 0.0, 0.02) << "it is a density";
  const auto best = std::max_element(prior.begin(), prior.end()) - prior.begin();
  EXPECT_NEAR(LevelGrid::At(static_cast<int>(best)), 0.0, LevelGrid::kStep);
  // Without any sun, the unit of the samples is eleven times too bright.
  EXPECT_NEAR(open.LogShade(std::log(11.0)), std::log(11.0), 1e-9);
  EXPECT_EQ(MarkerExposure({}, {1, 1, 1}, {}, 0.5, 0.0).LogShade(1.0), 0.0) << "no marker";
}

TEST(MarkerExposure, TakesDapplesForShade) {
  MarkerLight marker = Marker();
  const double part = std::log(11.0 / 8.0);
  const MarkerExposure even(marker, {1, 1, 1}, marker.sun, 0.3, 0.0);
  marker.dappled = true;
  const MarkerExposure dappled(marker, {1, 1, 1}, marker.sun, 0.3, 0.0);
  EXPECT_LT(dappled.LogPrior(0.0), even.LogPrior(0.0));
  EXPECT_NEAR(dappled.LogShade(part), part, 1e-9);
}

TEST(MarkerExposure, AllowsForTheSkyThatACrownHides) {
  const MarkerLight marker = Marker();
  // Without any sun and a fifth of the sky.
  const double dim = std::log(11.0 / 0.8);
  const MarkerExposure beside_wall(marker, {1, 1, 1}, marker.sun, 0.9, 0.0);
  const MarkerExposure beneath_crown(marker, {1, 1, 1}, marker.sun, 0.9, 0.2);
  EXPECT_GT(beneath_crown.LogPrior(dim), beside_wall.LogPrior(dim) + 3.0);
  EXPECT_NEAR(beneath_crown.LogShade(dim), dim, 1e-9);
}

/// Cells of two surfaces in a row, every 0.2 m, beneath a sun in the zenith.
std::vector<LightCell> Row(int count) {
  std::vector<LightCell> cells(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    LightCell& cell = cells[static_cast<std::size_t>(i)];
    cell.surface = i % 2;
    cell.plane = i % 2;
    cell.normal = {0, 0, 1};
    cell.albedo = {0.3, 0.3, 0.3};
    cell.sun = {10, 10, 10};
    cell.sunny.emplace();
    cell.sunny->place = {{0.2 * i, 0, 0}};
    cell.sunny->light = {{4, 4, 4}, {0, 0, 0}, {4, 4, 4}};
  }
  return cells;
}

TEST(ShadeField, ExpectsAroundAPlaceWhatItsNeighboursShow) {
  const std::vector<LightCell> cells = Row(20);
  const ShadeField field(cells, {0, 0, 1});
  // Two mixes: the second on the last ten cells.
  std::vector<double> posterior;
  for (int i = 0; i < 20; ++i)
    posterior.insert(posterior.end(), {i < 10 ? 1.0 : 0.0, i < 10 ? 0.0 : 1.0});
  const std::vector<double> prior = field.Prior(posterior, 2);
  ASSERT_EQ(prior.size(), 2 * 21u) << "the marker has the last row";
  for (std::size_t i = 0; i < 21; ++i) EXPECT_NEAR(prior[2 * i] + prior[2 * i + 1], 1.0, 1e-12);
  EXPECT_GT(prior[0], 0.8);
  EXPECT_LT(prior[2 * 19], 0.2);
  EXPECT_NEAR(prior[2 * 9], 0.5, 0.15) << "between both";
  EXPECT_NEAR(prior[2 * 20], prior[0], 0.1) << "the marker lies beside the first";
}

TEST(ShadedLevels, DoesNotDependOnWhereLevelsLieBetweenPointsOfTheGrid) {
  const auto evidence = [](double shift) {
    std::vector<LightCell> cells = Row(80);
    std::mt19937 random(3);
    std::normal_distribution<double> pattern(0.0, 0.06);
    for (LightCell& cell : cells)
      cell.sunny->log_rgb.fill(std::log(14 * 0.3 / std::numbers::pi) + pattern(random) + shift);
    constexpr std::array<UnmodelledShade, 1> kNone{{{0.01}}};
    constexpr std::array kNoError{ShadedLevels::SkyError{}};
    return LogSum(
        ShadedLevels(cells, nullptr, {0, 0, 1}, kNone, kNoError, 0.15,
                     [](const LightCell& cell, double) { return PredictInSun(cell, 0.0, 0.0); })
            .Uncoupled());
  };
  const double at_rest = evidence(0.0);
  for (const double part : {0.25, 0.5, 0.75})
    EXPECT_NEAR(evidence(part * LevelGrid::kStep), at_rest, 0.5) << part;
}

TEST(ShadedLevels, TakesADarkSurfaceForShadedWhereItsNeighboursAre) {
  // The first surface shows sun at one end and shade at the other. The second one is seen at one
  // end alone; its color is unknown.
  const auto level_of_second = [](bool at_shaded_end) {
    std::vector<LightCell> cells;
    for (LightCell& cell : Row(40)) {
      const double x = cell.sunny->place.xyz.x;
      const bool shaded = x > 4.0;
      if (cell.surface == 1 && shaded != at_shaded_end) continue;
      const double light = (cell.surface == 1 ? 3.6 : shaded ? 3.6 : 14.0);
      cell.sunny->log_rgb.fill(std::log(light * 0.3 / std::numbers::pi));
      cells.push_back(cell);
    }
    const ShadeField field(cells, {0, 0, 1});
    constexpr std::array<UnmodelledShade, 3> kMixes{{{0.02}, {0.4}, {0.95}}};
    constexpr std::array kNoError{ShadedLevels::SkyError{}};
    ShadedLevels levels(cells, &field, {0, 0, 1}, kMixes, kNoError, 0.15,
                        [](const LightCell& cell, double) { return PredictInSun(cell, 0.0, 0.0); });
    levels.At(0.0);
    levels.At(0.0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].surface == 1) return levels.LevelErrorOf(i);
    }
    return 0.0;
  };
  EXPECT_NEAR(level_of_second(true), 0.0, 0.1) << "of the described color, in shade";
  EXPECT_NEAR(level_of_second(false), std::log(3.6 / 14.0), 0.1) << "of a darker color, in the sun";
}

}  // namespace
}  // namespace pleinair::compositor
