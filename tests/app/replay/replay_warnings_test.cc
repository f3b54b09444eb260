#include "app/replay/replay_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pleinair::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

std::string WhereNothingWasSeen(std::optional<std::string> family, std::optional<int> id) {
  scene::SceneDescription scene;
  scene.marker.family = std::move(family);
  scene.marker.id = id;
  ReplayReport report;
  report.film.frames = 3;
  report.markers = {{"tag36h11", 4}};
  const auto warnings = MarkerWarnings(report, session::MarkerTracks(scene.marker), scene);
  EXPECT_THAT(warnings, SizeIs(1));
  return warnings.empty() ? "" : warnings[0];
}

TEST(ModelWarnings, ReportOnceOfAFileWhatOfItDoesNotShow) {
  compositor::Model model;
  model.file = "lamp.glb";
  model.materials.resize(2);
  model.materials[0].unsupported_features = {"normal maps", "emission"};
  model.materials[1].unsupported_features = {"KHR_materials_sheen"};  // Unused.
  model.meshes.emplace_back();
  const auto place = [](const compositor::Model& of, bool is_phantom) {
    compositor::PlacedModel placed;
    placed.model = std::make_shared<const compositor::Model>(of);
    placed.is_phantom = is_phantom;
    return placed;
  };
  EXPECT_THAT(ModelWarnings({place(model, false), place(model, false)}),
              ElementsAre("lamp.glb uses features that are not drawn: emission, normal maps."));
  EXPECT_THAT(ModelWarnings({place(model, true)}), IsEmpty());
}

TEST(MarkerWarnings, ReportWhatWasLookedForInVain) {
  EXPECT_THAT(WhereNothingWasSeen("tag25h9", 2), HasSubstr("(tag25h9_2) was seen in no frame"));
  EXPECT_THAT(WhereNothingWasSeen("tag25h9", 2), Not(HasSubstr("S-G")));
  EXPECT_THAT(WhereNothingWasSeen("sg", 17), HasSubstr("only number 17 was searched for"));
  EXPECT_THAT(WhereNothingWasSeen({}, {}), HasSubstr("(sg or tag36h11) was seen in no frame"));
  EXPECT_THAT(WhereNothingWasSeen({}, {}), HasSubstr("Seen: tag36h11_4."));
}

TEST(DrawingWarnings, ReportThatEdgesGetFewSamples) {
  EXPECT_THAT(DrawingWarnings(std::nullopt), IsEmpty());
  EXPECT_THAT(DrawingWarnings(4), IsEmpty());
  EXPECT_THAT(DrawingWarnings(1), ElementsAre(HasSubstr("gives 1 of 4 samples a pixel")));
}

TEST(LightWarnings, ReportWhatTheLightCannotBe) {
  session::LightSummary light;
  light.sun.elevation = FromDegrees(30);
  EXPECT_THAT(LightWarnings(light), IsEmpty());
  light.measured.sun_source = compositor::MeasuredLight::Source::kMeasured;
  light.measured.sun_shines = false;
  light.measured.sun_to_sky_stated = 4.0;
  EXPECT_THAT(LightWarnings(light), ElementsAre(HasSubstr("surfaces shows no sunlight")));
  light.measured.evidence.edges = light.measured.evidence.edges_agreeing = 9;
  EXPECT_THAT(LightWarnings(light), ElementsAre(HasSubstr("(9 shadow edges checked)")));
  light.measured = {};
  light.measured.sun_source = compositor::MeasuredLight::Source::kMarker;
  EXPECT_THAT(LightWarnings(light), ElementsAre(HasSubstr("shadow edge crosses the marker")));
  light.measured.sun_to_sky_stated = 4.0;
  EXPECT_THAT(LightWarnings(light), IsEmpty());
  light.measured = {};
  light.exposures.change = 2.5;
  EXPECT_THAT(LightWarnings(light), ElementsAre(HasSubstr("changed by a factor of 2.5")));
  light.exposures.change = 1.1;
  light.sun.elevation = FromDegrees(-5);
  EXPECT_THAT(LightWarnings(light), IsEmpty());
  light.sun.elevation = FromDegrees(-12);
  EXPECT_THAT(LightWarnings(light), ElementsAre(HasSubstr("12.0 degrees below the horizon")));
}

TEST(ReplayWarnings, SayWhatASceneOfCloudsAloneLacks) {
  EXPECT_EQ(NoObjectWarning(false), "The scene has no virtual object: the frames are unchanged.");
  EXPECT_THAT(NoObjectWarning(true), ::testing::HasSubstr("add [[object]] and [[phantom]]"));
}

}  // namespace
}  // namespace pleinair::app
