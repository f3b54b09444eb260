#include "session/scene_marker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::session {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

scene::SceneDescription Scene(std::optional<std::string> family, std::optional<int> id) {
  scene::SceneDescription scene;
  scene.file = "scene.json";
  scene.marker.family = std::move(family);
  scene.marker.id = id;
  scene.marker.size_m = 0.4;
  scene.marker.board_size_m = 0.5;
  return scene;
}

TEST(SceneMarker, OfNoNamedFamilyIsSoughtAmongOursAndTheUsualTags) {
  const auto options = TrackingOf(Scene(std::nullopt, std::nullopt));
  ASSERT_TRUE(options);
  EXPECT_THAT(options->families, ElementsAre("sg", "tag36h11"));
  EXPECT_THAT(options->sg.numbers_in_use, IsEmpty());
  EXPECT_TRUE(options->consecutive_frames);
  EXPECT_EQ(options->marker_size_m, 0.4);
}

TEST(SceneMarker, ThatIsNamedIsTheOnlyNumberInUse) {
  const auto options = TrackingOf(Scene("sg", 17));
  ASSERT_TRUE(options);
  EXPECT_THAT(options->families, ElementsAre("sg"));
  EXPECT_THAT(options->sg.numbers_in_use, ElementsAre(17));
  EXPECT_THAT(TrackingOf(Scene("tag25h9", 3))->sg.numbers_in_use, IsEmpty());
}

TEST(SceneMarker, OfAnUnknownVersionIsRefused) {
  scene::SceneDescription scene = Scene("sg", 17);
  scene.marker.version = tracker::sg::kVersion;
  EXPECT_TRUE(TrackingOf(scene));
  scene.marker.version = tracker::sg::kVersion + 1;
  const auto options = TrackingOf(scene);
  ASSERT_FALSE(options);
  EXPECT_THAT(options.error().Message(), HasSubstr("scene.json: has an S-G marker of version 2"));
}

TEST(SceneMarker, PrintsAreTheSizeOfTheirModules) {
  EXPECT_EQ(PatternOf({"sg", 17})->edge_modules, tracker::sg::kEdge);
  EXPECT_EQ(PatternOf({"tag36h11", 0})->edge_modules, 8);
  EXPECT_EQ(PatternOf({"sg", 4096}), nullptr);
  EXPECT_EQ(PatternOf({"sg", -1}), nullptr);
  EXPECT_EQ(PatternOf({"tag36h11", 100'000}), nullptr);
  EXPECT_EQ(PatternOf({"elsewhere", 0}), nullptr);
}

TEST(SceneMarker, MetersLightOnTheBandThatIsBlackInItsPrint) {
  const scene::MarkerDescription marker = Scene("sg", 17).marker;
  // The rim of an S-G marker is 4 of 40 modules; an AprilTag's band is one of 8 or of 6.
  EXPECT_DOUBLE_EQ(MarkerReflectanceOf(marker, {"sg", 17}).black_band_m, 0.04);
  EXPECT_DOUBLE_EQ(MarkerReflectanceOf(marker, {"tag36h11", 0}).black_band_m, 0.05);
  EXPECT_DOUBLE_EQ(MarkerReflectanceOf(marker, {"tag16h5", 0}).black_band_m, 0.4 / 6);
  EXPECT_EQ(MarkerReflectanceOf(marker, {"sg", 17}).board_size_m, 0.5);
}

}  // namespace
}  // namespace pleinair::session
