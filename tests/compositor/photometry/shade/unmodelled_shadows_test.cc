// What is told of shade that no phantom explains, on pictures whose light is known.
#include "compositor/photometry/shade/unmodelled_shadows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "compositor/light/sun_transmittance_map.h"
#include "compositor/photometry/heading_from_shadows.h"
#include "compositor/photometry/shade/ratio_from_shade.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "tests/compositor/photometry/shadow_light_yard.h"

namespace pleinair::compositor {
namespace {

using testing::PhotographedYard;
using testing::ShadowLight;
constexpr Vec3 kUp{0, 0, 1};

constexpr scene::MarkerPrint kPrint{.size_m = 0.2, .board_size_m = 0.25, .black_band_m = 0.02};
UnmodelledShade Shade(const SurfaceSamples& samples, const sky::SkyModel& model,
                      const LightSolver& solver) {
  const LightMeter meter(kPrint, solver, model, Mat3{});
  return FindUnmodelledShade(solver, samples, meter, model, Mat3{}, {1, 1, 1});
}

TEST_F(ShadowLight, DoubtsAnOvercastSkyWhereATreeShadesAllThePhantomsEdges) {
  const LightSolver& solver = yard_->solver();
  const SurfaceSamples samples =
      Look({.shaded = [](Vec3 p) { return yard_->IsBesideShadowEdge(p); }});
  EXPECT_EQ(Read(samples).sun, SunSkyReading::Sun::kHidden);
  const UnmodelledShade shade = Shade(samples, yard_->model(), solver);
  EXPECT_TRUE(shade.CastBySun()) << shade.crossed << " of " << shade.places;
  EXPECT_TRUE(shade.HidesEdges()) << shade.edges_shaded << " of " << shade.beside_edges;
}

TEST_F(ShadowLight, TellsTheSkyBesideTheSunFromHowDeepTheShadeOfTreesIs) {
  const auto tree = [](Vec3 p) { return std::sin(9 * p.x) * std::sin(11 * p.y + 3 * p.z) > 0.0; };
  for (const double truth : {1.0, 1.7, 2.5}) {
    const SurfaceSamples samples = Look({.sky_scale = LinearRgb{1, 1, 1} * truth, .shaded = tree});
    const UnmodelledShade shade = Shade(samples, yard_->model(), yard_->solver());
    const SunSkyReading reading = ReadShadeDepth(yard_->solver(), shade, yard_->model(), Mat3{});
    ASSERT_EQ(reading.sun, SunSkyReading::Sun::kShines);
    for (const double scale : {reading.sky_scale.r, reading.sky_scale.g, reading.sky_scale.b}) {
      EXPECT_NEAR(scale / truth, 1.0, 0.25) << truth;
    }
    EXPECT_LT(std::fabs(std::log(reading.sky_scale.g / truth)), 2 * reading.log_uncertainty);
    EXPECT_GT(reading.log_uncertainty, 0.2) << "it is no phantom's edge";
  }
  // Without trees there is nothing to read.
  const UnmodelledShade open = Shade(Look({}), yard_->model(), yard_->solver());
  EXPECT_FALSE(open.IsWide());
  EXPECT_EQ(ReadShadeDepth(yard_->solver(), open, yard_->model(), Mat3{}).sun,
            SunSkyReading::Sun::kUnknown);
}

TEST_F(ShadowLight, DoubtsAnOvercastSkyWhereTheTimeIsHoursOff) {
  const SurfaceSamples samples = Look({});
  const Vec3 to_sun = yard_->model().ToSun().xyz;
  int hidden = 0;
  for (const double off_deg : {-75.0, -50.0, 50.0, 75.0}) {
    const testing::UniformDay wrong({3000, 4200, 6500}, {62e3, 55e3, 44e3},
                                    Turned(to_sun, kUp, FromDegrees(off_deg)));
    const SunSkyReading reading =
        ReadSunAndSky(FindShadowEdges(yard_->solver(), samples, wrong, Mat3{}));
    EXPECT_NE(reading.sun, SunSkyReading::Sun::kShines) << off_deg;
    hidden += reading.sun == SunSkyReading::Sun::kHidden ? 1 : 0;
    const UnmodelledShade shade = Shade(samples, wrong, yard_->solver());
    EXPECT_TRUE(shade.CastBySun()) << off_deg << ": " << shade.crossed << " of " << shade.places;
    EXPECT_FALSE(shade.HidesEdges()) << off_deg << ": " << shade.edges_shaded;
  }
  EXPECT_GT(hidden, 0) << "without a doubt it would be taken for overcast";
}

TEST_F(ShadowLight, DoesNotDoubtAnOvercastSkyOverPatternedPaving) {
  for (const double strength : {1.0, 3.0}) {
    const SurfaceSamples samples =
        Look({.sky_scale = LinearRgb{1, 1, 1} * strength, .sun_scale = 0.0}, 3);
    EXPECT_EQ(Read(samples).sun, SunSkyReading::Sun::kHidden);
    const UnmodelledShade shade = Shade(samples, yard_->model(), yard_->solver());
    EXPECT_GT(shade.places, 100);
    EXPECT_FALSE(shade.CastBySun()) << shade.crossed << " of " << shade.places;
  }
}

TEST_F(ShadowLight, TellsHowMuchLiesInTheShadeOfTrees) {
  const UnmodelledShade open = Shade(Look({}), yard_->model(), yard_->solver());
  EXPECT_FALSE(open.IsWide());
  EXPECT_GT(open.sunlit, 100);
  EXPECT_FALSE(open.Matters()) << open.shaded;
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  const SurfaceSamples samples = Look({.shaded = tree});
  const UnmodelledShade shade = Shade(samples, yard_->model(), yard_->solver());
  EXPECT_TRUE(shade.Matters());
  // As much as there is: of the spots that the model has in the sun, those under the tree.
  int lit = 0, under = 0;
  for (const SurfaceSample& spot : samples.samples()) {
    const Vec3 to_sun = yard_->model().ToSun().xyz;
    if (spot.frames == 0 || spot.surface < 0 || Dot(spot.normal, to_sun) < 0.2) continue;
    if (!yard_->solver().ReachesPhantomsOnly(spot.point, to_sun)) continue;
    ++lit;
    under += tree(spot.point.xyz) ? 1 : 0;
  }
  EXPECT_NEAR(shade.shaded, static_cast<double>(under) / lit, 0.08);
}

TEST_F(ShadowLight, MapsWhereTheSunComesThroughTrees) {
  // Stripes across the sun's rays, as of things so far off that they shade whatever a ray meets.
  const Vec3 to_sun = Normalized(yard_->model().ToSun().xyz);
  const Vec3 across = Normalized(Cross(to_sun, kUp));
  const auto tree = [&](Vec3 p) { return std::sin(7 * Dot(p, across)) > 0.0; };
  const UnmodelledShade shade = Shade(Look({.shaded = tree}), yard_->model(), yard_->solver());
  ASSERT_TRUE(shade.Matters());
  int right = 0, points = 0;
  for (int column = -8; column <= 8; ++column) {
    for (int row = -8; row <= 2; ++row) {
      const Vec3 ground{0.1 * column, 0.1 * row, 0.0};
      if (!yard_->solver().ReachesPhantomsOnly({ground}, to_sun)) continue;
      // On the way to the ground, where something virtual would be.
      for (const double above : {0.0, 0.3, 0.6}) {
        if (std::fabs(std::sin(7 * Dot(ground, across))) < 0.3) continue;
        ++points;
        const double share = shade.sunlight.At(ground + to_sun * above);
        right += (share < 0.5) == tree(ground) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(points, 200);
  EXPECT_GT(right, 0.95 * points);
}

TEST(SeenSunlight, IsEmptyWhereAFewSpotsLieInOppositeCorners) {
  // Either direction's quantiles leave out one of them.
  const SeenSunlight aim = MapSeenSunlight({0.3, 0.2, 1.0}, std::vector<SunlitSpot>{{{}, 1, 0.1}});
  const std::vector<SunlitSpot> spots{{aim.across_y * 1.0, 0.3, 0.1}, {aim.across_x * 1.0, 1, 0.1}};
  const SeenSunlight map = MapSeenSunlight({0.3, 0.2, 1.0}, spots);
  EXPECT_TRUE(map.share.empty());
  EXPECT_EQ(map.At({}), 1.0);
}

TEST_F(ShadowLight, TellsFromTheGroundHowMuchDarkerThanTheSunThePrintIs) {
  // The frames' gain is read from a print that has 0.7 of the open light.
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  SurfaceSamples samples(yard_->solver(), yard_->camera(), yard_->print());
  constexpr double kOnPrint = 0.7;
  const double gain = kOnPrint * PhotographedYard::kGain;
  for (const int i : {0, 1}) {
    samples.AddFrame(yard_->Photograph(i, {.shaded = tree}).view(), PhotographedYard::Pose(i),
                     {gain, gain, gain});
  }
  const UnmodelledShade shade = Shade(samples, yard_->model(), yard_->solver());
  // The stated colours are not the paving's own.
  EXPECT_NEAR(shade.open_gain * kOnPrint, 1.0, 0.12);
  EXPECT_NEAR(shade.sun_on_print.g, yard_->model().SunNormalIrradiance().g * yard_->ToSun().z, 1.0);
}

/// The yard as a print in the shade of a tree has it: its gain is too high by that shade's depth.
SurfaceSamples FromAShadedPrint(const PhotographedYard& yard, PhotographedYard::Light light,
                                double* true_gain) {
  light.colours_as_stated = true;
  SurfaceSamples samples(yard.solver(), yard.camera(), yard.print());
  const double sun = yard.model().SunNormalIrradiance().g * yard.ToSun().z;
  const double sky = yard.model().SkyHorizontalIrradiance().g;
  *true_gain = (sun + sky) / sky;
  const double gain = PhotographedYard::kGain / *true_gain;
  for (const int i : {0, 1}) {
    samples.AddFrame(yard.Photograph(i, light).view(), PhotographedYard::Pose(i),
                     {gain, gain, gain});
  }
  return samples;
}

TEST_F(ShadowLight, TellsByOtherSurfacesThatPrintAndGroundLieInShadeAsAWhole) {
  // On the ground there is nothing to compare with; a part of what stands on it has the sun.
  double true_gain = 0.0;
  const SurfaceSamples samples = FromAShadedPrint(
      *yard_, {.shaded = [](Vec3 p) { return p.z < 0.02 || p.x < -0.5; }}, &true_gain);
  const UnmodelledShade shade = Shade(samples, yard_->model(), yard_->solver());
  EXPECT_NEAR(shade.open_gain / true_gain, 1.0, 0.15);
  EXPECT_TRUE(shade.open_gain_agreed);
  EXPECT_GT(shade.shaded, 0.7);
  EXPECT_TRUE(shade.IsWide());
  ASSERT_FALSE(shade.sunlight.share.empty());
  EXPECT_LT(shade.sunlight.At({0.2, -0.3, 0.0}), 0.2) << "beside the print";
  // How deep the shade is tells the sky's strength, though no edge of it is to be seen.
  UnmodelledShade edgeless = shade;
  edgeless.crossings.clear();
  const SunSkyReading reading = ReadShadeDepth(yard_->solver(), edgeless, yard_->model(), Mat3{});
  ASSERT_EQ(reading.sun, SunSkyReading::Sun::kShines);
  EXPECT_NEAR(reading.sky_scale.g, 1.0, 0.25);
  EXPECT_NEAR(reading.sky_scale.b / reading.sky_scale.r, 1.0, 0.15) << "it has the model's colour";
}

TEST_F(ShadowLight, BelievesThePrintWhereTheGroundShowsSunAndShade) {
  // Half the ground lies in a tree's shade, the print does not; the bricks are brighter than said.
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  SurfaceSamples samples(yard_->solver(), yard_->camera(), yard_->print());
  for (const int i : {0, 1}) {
    samples.AddFrame(yard_->Photograph(i, {.shaded = tree}).view(), PhotographedYard::Pose(i),
                     LinearRgb{1, 1, 1} * PhotographedYard::kGain);
  }
  EXPECT_NEAR(Shade(samples, yard_->model(), yard_->solver()).open_gain, 1.0, 0.15);
}

TEST_F(ShadowLight, BelievesSurfacesOfTwoColoursOfWhichOneIsStatedTooDark) {
  // The print has a good half of the open light. What stands on the ground is brighter than said,
  // so that it asks for more gain than the ground does, whose sun and shade contradict it; that the
  // print is too dark both say.
  constexpr double kOnPrint = 0.57, kBrighter = 1.4;
  SurfaceSamples samples(yard_->solver(), yard_->camera(), yard_->print());
  for (const int i : {0, 1}) {
    const RgbImage picture = yard_->Photograph(
        i, {.shaded = [](Vec3 p) { return p.z < 0.02 ? p.x + p.y < -0.2 : p.x > 0.3; },
            .colours_as_stated = true,
            .brighter = [](Vec3 p) { return p.z > 0.02 ? kBrighter : 1.0; }});
    samples.AddFrame(picture.view(), PhotographedYard::Pose(i),
                     LinearRgb{1, 1, 1} * (kOnPrint * PhotographedYard::kGain));
  }
  const UnmodelledShade shade = Shade(samples, yard_->model(), yard_->solver());
  EXPECT_TRUE(shade.ShadesPrint());
  EXPECT_GT(shade.open_gain * kOnPrint, 0.95);
  EXPECT_LT(shade.open_gain * kOnPrint, kBrighter - 0.05);
}

TEST_F(ShadowLight, SeesBesideThePrintThatItLiesInTheGroundsShade) {
  // The ground's bright part, in half-light, is no brighter than the open sun would be if the print
  // lay in it: it seems to lie partly in the sun, against the wall, which has all of it.
  double true_gain = 0.0;
  const auto half_light = [](Vec3 p) { return p.z < 0.02 && p.x > 0.45 ? 2.2 : 1.0; };
  const SurfaceSamples samples = FromAShadedPrint(
      *yard_, {.shaded = [](Vec3 p) { return p.y < 1.15; }, .brighter = half_light}, &true_gain);
  const UnmodelledShade shade = Shade(samples, yard_->model(), yard_->solver());
  EXPECT_TRUE(shade.shown_beside_print);
  EXPECT_TRUE(shade.ShadesPrint());
  EXPECT_NEAR(shade.open_gain / true_gain, 1.0, 0.15);
}

TEST_F(ShadowLight, TakesADarkMatBeneathThePrintForNoShade) {
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  const auto mat = [](Vec3 p) {
    const double beside = std::max(std::fabs(p.x), std::fabs(p.y));
    return beside > 0.125 && beside < 0.4 && p.z < 0.02 ? 0.3 : 1.0;
  };
  SurfaceSamples samples(yard_->solver(), yard_->camera(), yard_->print());
  for (const int i : {0, 1}) {
    samples.AddFrame(
        yard_->Photograph(i, {.shaded = tree, .colours_as_stated = true, .brighter = mat}).view(),
        PhotographedYard::Pose(i), LinearRgb{1, 1, 1} * PhotographedYard::kGain);
  }
  const UnmodelledShade shade = Shade(samples, yard_->model(), yard_->solver());
  ASSERT_TRUE(shade.Matters());
  EXPECT_FALSE(shade.shown_beside_print);
  EXPECT_FALSE(shade.ShadesPrint());
}

TEST_F(ShadowLight, TakesAPatternBesideThePrintForNoShadeUnderAFaintSun) {
  // A shadow is no deeper than paving that is a fifth darker around the print.
  constexpr double kFaint = 0.08;
  const ScaledDaylight faint(yard_->model(), {1, 1, 1}, {kFaint, kFaint, kFaint});
  const auto darker = [](Vec3 p) {
    const double beside = std::max(std::fabs(p.x), std::fabs(p.y));
    return beside > 0.125 && beside < 0.4 && p.z < 0.02 ? 0.82 : 1.0;
  };
  SurfaceSamples samples(yard_->solver(), yard_->camera(), yard_->print());
  for (const int i : {0, 1}) {
    samples.AddFrame(
        yard_->Photograph(i, {.sun_scale = kFaint, .colours_as_stated = true, .brighter = darker})
            .view(),
        PhotographedYard::Pose(i), LinearRgb{1, 1, 1} * PhotographedYard::kGain);
  }
  const LightMeter meter(kPrint, yard_->solver(), faint, Mat3{});
  const UnmodelledShade shade =
      FindUnmodelledShade(yard_->solver(), samples, meter, faint, Mat3{}, {1, 1, 1});
  ASSERT_TRUE(shade.Matters());
  EXPECT_FALSE(shade.shown_beside_print);
  EXPECT_FALSE(shade.ShadesPrint());
}

TEST(UnmodelledShade, TellsHowMuchDarkerThanTheSunAPrintOnAWallIs) {
  // The paving is a wall, what stands on it an awning; under a sky as bright as the sun's light,
  // of which a wall sees half.
  const Mat3 on_wall{{1, 0, 0, 0, 0, 1, 0, -1, 0}};
  const PhotographedYard yard({-0.5, 0.6, 0.62}, {10e3, 12e3, 14e3}, on_wall);
  const LightMeter meter(yard.print(), yard.solver(), yard.model(), on_wall);
  ASSERT_TRUE(meter.in_sun());
  SurfaceSamples samples(yard.solver(), yard.camera(), yard.print());
  constexpr double kOnPrint = 0.7;
  const double gain = kOnPrint * PhotographedYard::kGain;
  const auto tree = [](Vec3 p) { return p.x + p.y < -0.6; };
  for (const int i : {0, 1}) {
    samples.AddFrame(yard.Photograph(i, {.shaded = tree}).view(), PhotographedYard::Pose(i),
                     {gain, gain, gain});
  }
  const UnmodelledShade shade =
      FindUnmodelledShade(yard.solver(), samples, meter, yard.model(), on_wall, {1, 1, 1});
  ASSERT_TRUE(shade.Matters());
  EXPECT_NEAR(shade.open_gain * kOnPrint, 1.0, 0.12);
  const LinearRgb level = yard.model().SkyHorizontalIrradiance();
  EXPECT_LT(shade.ambient_on_print.g, 0.8 * level.g)
      << "half the sky, and what the land sends back";
  EXPECT_GT(shade.ambient_on_print.g, 0.4 * level.g);
}

}  // namespace
}  // namespace pleinair::compositor
