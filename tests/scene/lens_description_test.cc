#include "scene/lens_description.h"

#include <gmock/gmock.h>

#include <string>

#include "scene/scene_facts.h"
#include "tests/error_message.h"

namespace pleinair::scene {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Result<SceneFacts> Toml(const std::string& keys) {
  return ParseSceneToml("[lens]\n" + keys, "site/scene.toml");
}
Result<SceneFacts> Json(const std::string& keys) {
  return ParseSceneJson("{\"lens\": {" + keys + "}}", "site/recording.json");
}

TEST(LensDescription, ReadsEveryKeyOfAScene) {
  const auto read = Toml(
      "focus_m = 1.6\nf_number = 2.8\nfocal_length_mm = 33.6\nblades = 7\n"
      "blade_rotation_deg = -12.5\n");
  ASSERT_TRUE(read) << read.error().Message();
  ASSERT_TRUE(read->camera.lens);
  EXPECT_TRUE(read->camera.lens->IsComplete());
  EXPECT_THAT(read->camera.lens->focus_dioptres, ElementsAre(0.625));
  EXPECT_NEAR(*read->camera.lens->aperture_m, 0.012, 1e-12);
  EXPECT_EQ(read->camera.lens->blades, 7);
  EXPECT_EQ(read->camera.lens->blade_rotation_deg, -12.5);
  EXPECT_NEAR(*Toml("aperture_mm = 12\n")->camera.lens->aperture_m, 0.012, 1e-12);
  EXPECT_FALSE(Toml("aperture_mm = 12\n")->camera.lens->IsComplete());
  EXPECT_THAT(Toml("focus_m = \"infinity\"\n")->camera.lens->focus_dioptres, ElementsAre(0.0));
}

TEST(LensDescription, ReadsMetadataWithOneFocusAFrame) {
  EXPECT_THAT(Json("\"focus_m\": [1, 2.0, 4]")->camera.recorded_lens->focus_dioptres,
              ElementsAre(1.0, 0.5, 0.25));
  EXPECT_THAT(Json("\"focus_dioptres\": [0, 2.5]")->camera.recorded_lens->focus_dioptres,
              ElementsAre(0.0, 2.5));
  EXPECT_THAT(Json("\"focus_dioptres\": 2.5")->camera.recorded_lens->focus_dioptres,
              ElementsAre(2.5));
  EXPECT_THAT(Json("\"focus_m\": \"infinity\"")->camera.recorded_lens->focus_dioptres,
              ElementsAre(0.0));
  EXPECT_FALSE(Json("")->camera.lens);
}

TEST(LensDescription, ReadsExposures) {
  EXPECT_THAT(Toml("exposure_ms = 8.5\n")->camera.lens->exposure_s,
              ElementsAre(::testing::DoubleEq(8.5e-3)));
  EXPECT_FALSE(Toml("exposure_ms = 8.5\n")->camera.lens->IsComplete());
  EXPECT_THAT(Json("\"exposure_ms\": 4")->camera.recorded_lens->exposure_s,
              ElementsAre(::testing::DoubleEq(4e-3)));
  EXPECT_THAT(Json("\"exposure_ms\": [4, 2]")->camera.recorded_lens->exposure_s,
              ElementsAre(::testing::DoubleEq(4e-3), ::testing::DoubleEq(2e-3)));
  const auto refused = [](const Result<SceneFacts>& read, const char* message) {
    EXPECT_THAT(tests::MessageOf(read), HasSubstr(message));
  };
  refused(Toml("exposure_ms = 0\n"), "\"exposure_ms\" is not greater than zero");
  refused(Toml("exposure_ms = nan\n"), "not finite");
  refused(Json("\"exposure_ms\": [4, -2]"), "\"exposure_ms\" is not greater than zero");
  refused(Json("\"exposure_ms\": []"), "empty");
  refused(Json("\"exposure_ms\": \"long\""), "site/recording.json");
}

TEST(LensDescription, RefusesImpossibleLensesByFile) {
  const auto toml = [](const std::string& keys) { return tests::MessageOf(Toml(keys)); };
  const auto json = [](const std::string& keys) { return tests::MessageOf(Json(keys)); };
  EXPECT_THAT(toml("focus_m = 0\n"),
              AllOf(StartsWith("site/scene.toml:1"), HasSubstr("not greater than zero")));
  EXPECT_THAT(toml("focus_m = -1\n"), HasSubstr("not greater than zero"));
  EXPECT_THAT(toml("focus_m = nan\n"), HasSubstr("not finite"));
  EXPECT_THAT(toml("focus_m = \"far\"\n"), HasSubstr("neither a number nor"));
  EXPECT_THAT(toml("aperture_mm = 0\n"), HasSubstr("not greater than zero"));
  EXPECT_THAT(toml("f_number = -2\nfocal_length_mm = 30\n"), HasSubstr("not greater than zero"));
  EXPECT_THAT(toml("aperture_mm = 3\nf_number = 2\nfocal_length_mm = 6\n"),
              HasSubstr("both given"));
  EXPECT_THAT(toml("f_number = 2\n"), HasSubstr("without \"focal_length_mm\""));
  EXPECT_THAT(toml("focal_length_mm = 30\n"), HasSubstr("without \"f_number\""));
  for (const char* blades : {"1", "2", "17"}) {
    EXPECT_THAT(toml(std::string("blades = ") + blades + "\n"), HasSubstr("3 to 16"));
  }
  EXPECT_TRUE(Toml("blades = 0\n"));
  EXPECT_THAT(toml("focus_m = 0.04\nf_number = 2\nfocal_length_mm = 50\n"),
              HasSubstr("nearer than the focal length"));
  EXPECT_THAT(toml("focus = 1\n"), HasSubstr("is unknown"));
  EXPECT_THAT(json("\"focus_m\": [1, -2]"),
              AllOf(StartsWith("site/recording.json"), HasSubstr("not greater than zero")));
  EXPECT_THAT(json("\"focus_m\": [1, NaN]"), StartsWith("site/recording.json"));
  EXPECT_THAT(json("\"focus_m\": []"), HasSubstr("empty"));
  EXPECT_THAT(json("\"focus_m\": [1, null]"), StartsWith("site/recording.json"));
  EXPECT_THAT(json("\"focus_m\": 1, \"focus_dioptres\": 1"), HasSubstr("both given"));
  EXPECT_THAT(json("\"focus_dioptres\": [-1]"), HasSubstr("from 0 up"));
}

}  // namespace
}  // namespace pleinair::scene
