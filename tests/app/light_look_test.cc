// What is concluded from frames, and what is not.
#include "app/light_look.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/app/yard_scene.h"

namespace pleinair::app {
namespace {

using compositor::testing::PhotographedYard;

const PhotographedYard& Yard() {
  static const PhotographedYard yard;
  return yard;
}

/// What a sunny yard tells where the scene has the sun `off_deg` beside its place.
FoundLight Settle(double off_deg, const PhotographedYard::Light& light,
                  const LightOverrides& overrides = {},
                  const char* said_time = "2025-09-14T13:50:00Z") {
  const PhotographedYard& yard = Yard();
  const UtcTime time = *UtcTime::Parse(said_time);
  const devices::SceneDescription scene = YardScene(yard, off_deg, time);
  const std::shared_ptr<const compositor::LightSolver> solver(&yard.solver(), [](const auto*) {});
  LightLook look(solver, yard.camera(), yard.print(), scene, overrides, time, {});
  for (const int i : {0, 1}) look.Add(yard.Photograph(i, light).view(), PhotographedYard::Pose(i));
  LightMemory memory;
  return look.Settle(&memory);
}

LightOverrides SunToSkyOf(double ratio) {
  LightOverrides overrides;
  overrides.sun_to_sky = ratio;
  return overrides;
}

TEST(LightLook, SeesThatTheSunShines) {
  const FoundLight found = Settle(0.0, {});
  EXPECT_FALSE(found.measured.sun_doubtful);
  EXPECT_EQ(found.measured.sun_source, MeasuredLight::Source::kMeasured);
  EXPECT_GT(found.skies.source->ForSun({{0, 0, 1}}, 1.0)->SunNormalIrradiance().g, 0.0);
  EXPECT_EQ(found.skies.print_shade, (LinearRgb{1, 1, 1}));
}

TEST(LightLook, SeesThatNoSunShines) {
  const FoundLight found = Settle(0.0, {.sky_scale = {3, 3, 3}, .sun_scale = 0.0});
  EXPECT_FALSE(found.measured.sun_doubtful);
  EXPECT_EQ(found.measured.sun_source, MeasuredLight::Source::kMeasured);
  EXPECT_EQ(found.skies.source->ForSun({{0, 0, 1}}, 1.0)->SunNormalIrradiance().g, 0.0);
}

TEST(LightLook, SeesByPlanesThatNoSunShinesWhereAllLiesBehindAWall) {
  // The scene's sun stands low behind the yard's wall: hardly an edge of a shadow is in view.
  const auto settle = [](const PhotographedYard::Light& light) {
    return Settle(245.0, light, {}, "2025-09-14T16:45:00Z");
  };
  const FoundLight veiled = settle({.sky_scale = {3, 3, 3}, .sun_scale = 0.0});
  EXPECT_LT(veiled.measured.edges, 3);
  EXPECT_EQ(veiled.measured.sun_source, MeasuredLight::Source::kMeasured);
  ASSERT_NE(veiled.skies.source, nullptr);
  EXPECT_EQ(veiled.skies.source->ForSun({{0, 0, 1}}, 1.0)->SunNormalIrradiance().g, 0.0);
  // Under a sun that stands elsewhere planes are not lit as by clouds either.
  EXPECT_EQ(settle({}).measured.sun_source, MeasuredLight::Source::kStated);
}

TEST(LightLook, SeesByStatedColoursThatNoSunShinesWherePlanesOfOneMaterialDoNotTell) {
  // Beside the wall, in view of another part of the sky.
  const auto settle = [](PhotographedYard::Light light) {
    light.colours_as_stated = true;
    return Settle(230.0, light, {}, "2025-09-14T16:45:00Z").measured;
  };
  const MeasuredLight veiled = settle({.sky_scale = {3, 3, 3}, .sun_scale = 0.0});
  EXPECT_LT(veiled.edges, 3);
  EXPECT_EQ(veiled.sun_source, MeasuredLight::Source::kMeasured);
  EXPECT_EQ(settle({}).sun_source, MeasuredLight::Source::kStated);
}

TEST(LightLook, ReadsTheSkyFromTheShadeOfATreeThatHidesAllEdges) {
  const PhotographedYard& yard = Yard();
  const auto tree = [&](Vec3 p) {
    return yard.IsBesideShadowEdge(p) || std::sin(9 * p.x) * std::sin(11 * p.y + 3 * p.z) > 0.0;
  };
  const FoundLight hazy = Settle(0.0, {.sky_scale = {2.5, 2.5, 2.5}, .shaded = tree});
  EXPECT_FALSE(hazy.measured.sun_doubtful);
  EXPECT_EQ(hazy.measured.sun_source, MeasuredLight::Source::kShade);
  EXPECT_GE(hazy.measured.shade_places, 4);
  EXPECT_GT(hazy.measured.sun_to_sky_error, 0.1);
  ASSERT_NE(hazy.skies.source, nullptr);
  EXPECT_NE(hazy.skies.sunlight, nullptr);
  // Words that have the sky much fainter beside the sun count for something; less than half.
  const sky::SkyModel& model = yard.model();
  const auto off = [&](const sky::SkySource& skies, LinearRgb scale) {
    const auto day = skies.ForSun(model.ToSun(), 1.0);
    const auto share = [](const sky::SkyModel& of) {
      return of.SkyHorizontalIrradiance().g / of.SunNormalIrradiance().g;
    };
    return std::fabs(std::log(share(*day) * scale.g / (2.5 * share(model))));
  };
  devices::SceneDescription words;
  words.cloudiness = devices::Cloudiness::kClear;
  const double stated = off(*StatedSky(words), {1, 1, 1});
  EXPECT_GT(stated, 0.8);
  EXPECT_LT(off(*hazy.skies.source, hazy.skies.scale), 0.5 * stated);
}

TEST(LightLook, KeepsTheMapUnderAGivenRatio) {
  const PhotographedYard& yard = Yard();
  const auto leaves = [&](Vec3 p) { return std::sin(9 * p.x) * std::sin(11 * p.y) > 0.0; };
  const FoundLight found = Settle(0.0, {.shaded = leaves}, SunToSkyOf(2.0));
  EXPECT_FALSE(found.measured.sun_doubtful);
  EXPECT_NE(found.skies.sunlight, nullptr);
  ASSERT_NE(found.skies.source, nullptr);
  EXPECT_GT(found.skies.source->ForSun(yard.model().ToSun(), 1.0)->SunNormalIrradiance().g, 0.0);
}

/// How pixels are asked for shade where the user says of the light what `overrides` has.
DaySkies GivenSkies(const LightOverrides& overrides, const PhotographedYard::Light& light) {
  const FoundLight found = Settle(0.0, light, overrides);
  EXPECT_EQ(found.measured.heading_source, MeasuredLight::Source::kStated);
  EXPECT_EQ(found.measured.sun_source, MeasuredLight::Source::kStated);
  EXPECT_EQ(found.measured.heading_offset.value(), 0.0);
  EXPECT_NE(found.skies.source, nullptr);
  return found.skies;
}

TEST(LightLook, AsksUnderAStatedLightForShadeAlone) {
  LightOverrides stated;
  stated.as_stated = true;
  const DaySkies open = GivenSkies(stated, {});
  EXPECT_FALSE(open.other_shade) << "joints and edges would look shaded";
  EXPECT_EQ(open.scale, (LinearRgb{1, 1, 1}));
  const DaySkies hazy = GivenSkies(stated, {.sky_scale = {1.5, 1.5, 1.5}});
  EXPECT_FALSE(hazy.other_shade);
  const auto of = [](const DaySkies& skies) {
    return skies.source->ForSun({{0.6, 0.0, 0.8}}, 1.0)->SkyHorizontalIrradiance();
  };
  EXPECT_EQ(of(hazy), of(open)) << "measured, though it is stated";
  const auto leaves = [](Vec3 p) { return std::sin(9 * p.x) * std::sin(11 * p.y) > 0.0; };
  const DaySkies shaded = GivenSkies(stated, {.shaded = leaves});
  EXPECT_TRUE(shaded.other_shade);
  EXPECT_EQ(shaded.sunlight, nullptr);
  EXPECT_EQ(shaded.print_shade, (LinearRgb{1, 1, 1}));
}

TEST(LightLook, AsksForShadeWhereRatioAndHeadingAreGiven) {
  LightOverrides given = SunToSkyOf(3.0);
  given.heading_deg = 0.0;  // That it is given counts; the scene has it already.
  EXPECT_FALSE(GivenSkies(given, {}).other_shade);
  const auto leaves = [](Vec3 p) { return std::sin(9 * p.x) * std::sin(11 * p.y) > 0.0; };
  const DaySkies shaded = GivenSkies(given, {.shaded = leaves});
  EXPECT_TRUE(shaded.other_shade);
  EXPECT_NE(shaded.sunlight, nullptr);
}

TEST(LightLook, DoubtsNoSunThatIsGiven) {
  // Elsewhere than the shadows say: doubtful as the words have it, not as the user does.
  const FoundLight found = Settle(60.0, {}, SunToSkyOf(2.0));
  EXPECT_FALSE(found.measured.sun_doubtful);
  EXPECT_EQ(found.skies.sunlight, nullptr);
}

TEST(LightLook, BelievesTheWordsAloneWhereTheSunStandsElsewhere) {
  const FoundLight found = Settle(60.0, {});
  EXPECT_TRUE(found.measured.sun_doubtful);
  EXPECT_EQ(found.measured.sun_source, MeasuredLight::Source::kStated);
  EXPECT_EQ(found.skies.source, nullptr);
  EXPECT_EQ(found.skies.sunlight, nullptr) << "the phantoms' own shadows would be leaves'";
}

}  // namespace
}  // namespace pleinair::app
