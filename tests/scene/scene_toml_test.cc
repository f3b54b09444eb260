#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/scene_description.h"
#include "tests/temporary_folder.h"

namespace pleinair::scene {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kScene = R"(time = 2025-09-14T13:05:00+02:00
cloudiness = "Hazy"
turbidity = 3.5
exposure_gain = [0.03, 0.035, 0.04]

[place]
latitude_deg = 50.0875
longitude_deg = 14.4213
height_m = 220

[marker]
family = "tag36h11"
id = 7
size_mm = 480
board_size_mm = 600
heading_deg = 342

[[phantom]]
file = "models/ground.obj"

[[phantom]]
file = "models/wall.obj"

[[object]]
file = "models/tower.obj"
shading = "smooth"
translation_m = [1, 2.5, 0]
rotation_deg = [0, 0, 90]
scale = 0.001
)";

void WriteModels(const tests::TemporaryFolder& folder) {
  for (const char* name : {"ground", "wall", "tower"}) {
    folder.Write(std::string("models/") + name + ".obj", "v 0 0 0\n");
  }
}

std::string Refusal(std::string_view toml) {
  const tests::TemporaryFolder folder;
  WriteModels(folder);
  return tests::MessageOf(ReadSceneDescription(folder.Write("scene.toml", toml)));
}

TEST(SceneToml, SaysEverythingThatTheCompositorMayKnow) {
  const tests::TemporaryFolder folder;
  WriteModels(folder);
  const Result<SceneDescription> scene = ReadSceneDescription(folder.Write("scene.toml", kScene));
  ASSERT_TRUE(scene) << scene.error().Message();
  EXPECT_EQ(scene->file, folder / "scene.toml");
  EXPECT_EQ(scene->place_time.start.ToString(), "2025-09-14T11:05:00Z");
  EXPECT_EQ(scene->place_time.latitude_deg, 50.0875);
  EXPECT_EQ(scene->place_time.longitude_deg, 14.4213);
  EXPECT_EQ(scene->place_time.height_m, 220);
  EXPECT_EQ(scene->cloudiness, Cloudiness::kHazy);
  EXPECT_EQ(scene->turbidity, 3.5);
  EXPECT_EQ(scene->exposure_scale, (LinearRgb{0.03, 0.035, 0.04}));
  EXPECT_EQ(scene->marker.id, 7);
  EXPECT_DOUBLE_EQ(scene->marker.size_m, 0.48);
  EXPECT_DOUBLE_EQ(scene->marker.board_size_m, 0.6);
  EXPECT_DOUBLE_EQ(ToDegrees(scene->marker.heading), 342);
  EXPECT_FALSE(scene->marker.upright);
  ASSERT_EQ(scene->phantoms.size(), 2U);
  EXPECT_EQ(scene->phantoms[1].file, folder / "models/wall.obj");
  EXPECT_EQ(scene->phantoms[1].shading, Shading::kFromFile);
  ASSERT_EQ(scene->objects.size(), 1U);
  EXPECT_EQ(scene->objects[0].shading, Shading::kSmooth);
  EXPECT_EQ(scene->objects[0].translation_m, (Vec3{1, 2.5, 0}));
  EXPECT_EQ(scene->objects[0].rotation_deg, (Vec3{0, 0, 90}));
  EXPECT_EQ(scene->objects[0].scale, 0.001);
}

TEST(SceneToml, LeavesOutWhatHasADefault) {
  const tests::TemporaryFolder folder;
  const Result<SceneDescription> scene = ReadSceneDescription(folder.Write(
      "scene.toml",
      "time = \"2025-09-14T11:05:00Z\"\nplace = {latitude_deg = -33, longitude_deg = 151}\n"
      "marker = {size_m = 0.2, heading_deg = -90, upright = true}\n"));
  ASSERT_TRUE(scene) << scene.error().Message();
  EXPECT_FALSE(scene->marker.family);
  EXPECT_FALSE(scene->marker.id);
  EXPECT_DOUBLE_EQ(scene->marker.board_size_m, 0.25);
  EXPECT_TRUE(scene->marker.upright);
  EXPECT_EQ(scene->cloudiness, Cloudiness::kClear);
  EXPECT_FALSE(scene->turbidity);
  EXPECT_FALSE(scene->exposure_scale);
  EXPECT_TRUE(scene->objects.empty());
}

TEST(SceneToml, TimeMayStandInThePlaceToo) {
  const std::string text =
      tests::Replaced(tests::Replaced(kScene, "time = 2025-09-14T13:05:00+02:00\n", ""),
                      "height_m = 220", "time = 2025-09-14T11:05:00Z");
  EXPECT_EQ(Refusal(text), "no error");
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "height_m = 220", "time = 2025-09-14T11:05:00Z")),
              HasSubstr("given here and at the top"));
}

TEST(SceneToml, UnknownKeysAreRefusedWithTheirLine) {
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "turbidity", "turbid")),
              AllOf(HasSubstr("scene.toml:3: \"turbid\" is unknown"), HasSubstr("turbidity")));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "height_m", "altitude")),
              HasSubstr("scene.toml:9: \"altitude\" is unknown"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "scale", "size")), HasSubstr("scene.toml:29"));
}

TEST(SceneToml, LocalTimeIsRefused) {
  for (const char* time :
       {"2025-09-14T11:05:00", "\"2025-09-14T11:05:00\"", "2025-09-14", "11:05:00", "1757847900"}) {
    EXPECT_THAT(Refusal(tests::Replaced(kScene, "2025-09-14T13:05:00+02:00", time)),
                AllOf(HasSubstr("scene.toml:1: \"time\""), HasSubstr("RFC 3339")))
        << time;
  }
}

TEST(SceneToml, TimeMayNameItsZone) {
  const auto with = [](const char* time) {
    return Refusal(tests::Replaced(kScene, "2025-09-14T13:05:00+02:00", time));
  };
  EXPECT_EQ(with("\"2025-09-14T13:05:00[Europe/Prague]\""), "no error");
  EXPECT_THAT(with("\"2025-09-14T13:05:00[Europe/Prag]\""),
              AllOf(HasSubstr("scene.toml:1: \"time\""), HasSubstr("mean Europe/Prague?")));
}

TEST(SceneToml, ValuesMustBeInRange) {
  const auto with = [](const char* from, const char* to) {
    return Refusal(tests::Replaced(kScene, from, to));
  };
  EXPECT_THAT(with("50.0875", "90.5"), HasSubstr("latitude"));
  EXPECT_THAT(with("50.0875", "nan"), HasSubstr("scene.toml:7: \"latitude_deg\" is not finite"));
  EXPECT_THAT(with("14.4213", "-180.5"), HasSubstr("longitude"));
  EXPECT_THAT(with("220", "1e9"), HasSubstr("height"));
  EXPECT_THAT(with("size_mm = 480", "size_mm = 0"), HasSubstr("size is not greater than zero"));
  EXPECT_THAT(with("size_mm = 480", "size_mm = -1"), HasSubstr("size is not greater than zero"));
  EXPECT_THAT(with("size_mm = 480", "size_mm = inf"), HasSubstr("is not finite"));
  EXPECT_THAT(with("board_size_mm = 600", "board_size_mm = 400"), HasSubstr("smaller than its"));
  EXPECT_THAT(with("heading_deg = 342", "heading_deg = 720"), HasSubstr("heading"));
  EXPECT_THAT(with("turbidity = 3.5", "turbidity = 0"), HasSubstr("turbidity"));
  EXPECT_THAT(with("[0.03, 0.035, 0.04]", "[0.03, 0, 0.04]"), HasSubstr("exposure gain"));
  EXPECT_THAT(with("[0.03, 0.035, 0.04]", "[0.03, 0.04]"), HasSubstr("three numbers"));
  EXPECT_THAT(with("scale = 0.001", "scale = 0"), HasSubstr("greater than zero"));
  EXPECT_THAT(with("id = 7", "id = -7"), HasSubstr("whole number from 0 up"));
  EXPECT_THAT(with("[1, 2.5, 0]", "[1, 2.5, 1e30]"), HasSubstr("million metres"));
  EXPECT_THAT(with("\"smooth\"", "\"shiny\""), HasSubstr("known are file, flat and smooth"));
  EXPECT_THAT(with("\"Hazy\"", "\"grey\""), HasSubstr("known are clear, hazy"));
}

TEST(SceneToml, WhatIsMissingIsNamed) {
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "size_mm = 480\n", "")),
              HasSubstr("how large the marker"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "heading_deg = 342\n", "")), HasSubstr("which way"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "latitude_deg = 50.0875\n", "")), HasSubstr("where"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "time = 2025-09-14T13:05:00+02:00\n", "")),
              HasSubstr("when"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "file = \"models/wall.obj\"", "")),
              HasSubstr("no file"));
}

TEST(SceneToml, ModelThatIsNotThereIsNamedWithItsScene) {
  EXPECT_THAT(
      Refusal(tests::Replaced(kScene, "tower.obj", "castle.obj")),
      AllOf(HasSubstr("scene.toml"), HasSubstr("models/castle.obj"), HasSubstr("is not there")));
}

TEST(SceneToml, SyntaxErrorsSayTheirLine) {
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "2025-09-14T13:05:00+02:00", "2025-09-14Td:")),
              HasSubstr("scene.toml:"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "height_m = 220", "height_m = ")),
              AllOf(HasSubstr("scene.toml:9"), HasSubstr("is not TOML")));
  EXPECT_THAT(Refusal(std::string(kScene).substr(0, 250)), HasSubstr("is not TOML"));
}

// toml++ 3.3 had undefined behaviour here, which fuzzing found.
TEST(SceneToml, LettersOutsideOfQuotesAreAnErrorAndInsideThemAName) {
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "\"Hazy\"", "Größe")), HasSubstr("scene.toml:2"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "turbidity = 3.5", "туман = 3.5")),
              HasSubstr("scene.toml:3"));
  EXPECT_EQ(Refusal(tests::Replaced(kScene, "height_m = 220", "name = \"Хутор\"  # Größe")),
            "no error");
}

TEST(SceneToml, OneMarkerAnchorsTheScene) {
  EXPECT_EQ(Refusal(tests::Replaced(kScene, "[marker]", "[[marker]]")), "no error");
  EXPECT_THAT(Refusal(tests::Replaced(tests::Replaced(kScene, "[marker]", "[[marker]]"),
                                      "[[phantom]]", "[[marker]]\nsize_mm = 100\n[[phantom]]")),
              HasSubstr("given more than once"));
}

}  // namespace
}  // namespace pleinair::scene
