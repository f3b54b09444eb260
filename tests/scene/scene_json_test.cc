#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/cloudiness.h"
#include "scene/scene_facts.h"
#include "tests/temporary_folder.h"

namespace pleinair::scene {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kScene = R"({"name": "yard",
  "marker": {"black_square_side_m": 0.48, "board_size_m": 0.6, "heading_deg": 342,
             "albedo_black": 0.05, "albedo_white": 0.75, "what": "AprilTag tag25h9 id 12, white"},
  "place_time": {"latitude_deg": 50, "longitude_deg": 14, "utc": "2025-09-14T11:05:00Z"},
  "sky": {"clouds": "none"}})";

std::optional<Cloudiness> SkyOf(const std::string& json) {
  const Result<SceneFacts> facts = ParseSceneJson(json, "scene.json");
  return facts ? facts->cloudiness : std::nullopt;
}

std::string Refusal(const std::string& json) {
  const Result<SceneFacts> facts = ParseSceneJson(json, "scene.json");
  return facts ? tests::MessageOf(CompleteScene(*facts, "scene.json")) : facts.error().Message();
}

TEST(SceneJson, BundledSceneIsRead) {
  const Result<SceneDescription> scene = ReadSceneDescription(tests::Courtyard() / "scene.json");
  ASSERT_TRUE(scene) << scene.error().Message();
  EXPECT_EQ(scene->marker.family, "sg");
  EXPECT_EQ(scene->marker.id, 17);
  EXPECT_EQ(scene->marker.version, 1);
  EXPECT_EQ(scene->marker.size_m, 0.5);
  EXPECT_EQ(scene->marker.board_size_m, 0.6);
  EXPECT_EQ(scene->place_time.height_m, 220);
  EXPECT_EQ(scene->place_time.start.ToString(), "2025-09-14T11:05:00Z");
  EXPECT_EQ(scene->cloudiness, Cloudiness::kClear);
  ASSERT_EQ(scene->phantoms.size(), 1U);
  ASSERT_EQ(scene->objects.size(), 1U);
  EXPECT_EQ(scene->objects[0].file, tests::Courtyard() / "object.obj");
  EXPECT_EQ(scene->objects[0].shading, Shading::kFlat);
}

TEST(SceneJson, MarkerIsWhatItsWordsSayElseUnknown) {
  const Result<SceneFacts> named = ParseSceneJson(kScene, "scene.json");
  ASSERT_TRUE(named) << named.error().Message();
  EXPECT_EQ(named->marker.family, "tag25h9");
  EXPECT_EQ(named->marker.id, 12);
  EXPECT_EQ(named->marker.albedo_white, 0.75);
  const Result<SceneFacts> unnamed =
      ParseSceneJson(tests::Replaced(kScene, "AprilTag tag25h9 id 12", "a picture"), "scene.json");
  ASSERT_TRUE(unnamed);
  const Result<SceneDescription> scene = CompleteScene(*unnamed, "scene.json");
  ASSERT_TRUE(scene) << scene.error().Message();
  EXPECT_FALSE(scene->marker.family);
  EXPECT_FALSE(scene->marker.id);
  EXPECT_FALSE(scene->marker.version);
}

TEST(SceneJson, MarkerMayBeNamedWithItsVersion) {
  const Result<SceneFacts> facts = ParseSceneJson(
      tests::Replaced(kScene, "\"what\": \"AprilTag tag25h9 id 12, white\"",
                      R"("family": "sg", "id": 17, "version": 1, "what": "S-G id 3")"),
      "scene.json");
  ASSERT_TRUE(facts) << facts.error().Message();
  EXPECT_EQ(facts->marker.family, "sg");
  EXPECT_EQ(facts->marker.id, 17);
  EXPECT_EQ(facts->marker.version, 1);
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "\"what\"", "\"version\": \"one\", \"what\"")),
              HasSubstr("\"marker.version\" is not a number"));
}

TEST(SceneJson, SkyIsFoundInItsWordsWherever) {
  EXPECT_EQ(SkyOf(kScene), Cloudiness::kClear);
  EXPECT_EQ(SkyOf(tests::Replaced(kScene, "\"none\"", "\"None, HAZY\"")), Cloudiness::kHazy);
  EXPECT_EQ(SkyOf(tests::Replaced(kScene, "\"yard\"", "\"yard_haze\"")), Cloudiness::kHazy);
  EXPECT_EQ(SkyOf(tests::Replaced(kScene, "{\"clouds\": \"none\"}", "\"overcast\"")),
            Cloudiness::kOvercast);
  EXPECT_EQ(
      SkyOf(tests::Replaced(kScene, "\"clouds\": \"none\"", "\"condition\": \"Partly cloudy\"")),
      Cloudiness::kPartlyCloudy);
  EXPECT_EQ(SkyOf(R"({"weather": "scattered clouds at noon"})"), Cloudiness::kPartlyCloudy);
  EXPECT_EQ(SkyOf(R"({"cloudiness": "hazy"})"), Cloudiness::kHazy);
  EXPECT_EQ(SkyOf(R"({"place_time": {"weather": "overcast"}})"), Cloudiness::kOvercast);
}

TEST(SceneJson, TheSkyThatARenderingWasLitWithIsNotRead) {
  EXPECT_EQ(SkyOf(R"({"sky": {"model": "CIE overcast"}})"), std::nullopt);
}

TEST(SceneJson, UnknownSkyWordsLeaveTheDefault) {
  EXPECT_EQ(SkyOf(tests::Replaced(kScene, "none", "cumulonimbus")), std::nullopt);
  const Result<SceneFacts> facts =
      ParseSceneJson(tests::Replaced(kScene, "\"none\"", "7"), "scene.json");
  ASSERT_TRUE(facts);
  EXPECT_EQ(CompleteScene(*facts, "scene.json")->cloudiness, Cloudiness::kClear);
}

TEST(SkyWords, CloudierWordsWinOverClearerOnes) {
  EXPECT_EQ(ParseCloudiness("clear, later overcast"), Cloudiness::kOvercast);
  EXPECT_EQ(ParseCloudiness("partly cloudy"), Cloudiness::kPartlyCloudy);
  EXPECT_EQ(ParseCloudiness("cloudy"), Cloudiness::kOvercast);
  EXPECT_EQ(ParseCloudiness("BROKEN"), Cloudiness::kPartlyCloudy);
  EXPECT_EQ(ParseCloudiness("few"), Cloudiness::kClear);
  EXPECT_EQ(ParseCloudiness("unclear"), std::nullopt);
  EXPECT_EQ(ParseCloudiness(""), std::nullopt);
}

TEST(SceneJson, BadValuesAreRefusedByName) {
  EXPECT_EQ(Refusal(kScene), "no error");
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "0.48", "0")),
              HasSubstr("marker.size_m is 0, outside"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "0.48", "\"large\"")),
              HasSubstr("\"marker.black_square_side_m\" is not a number"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "0.48", "NaN")), HasSubstr("is not whole JSON"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "11:05:00Z", "11:05:00")),
              AllOf(HasSubstr("\"place_time.utc\""), HasSubstr("neither Z nor an offset")));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "\"latitude_deg\": 50", "\"latitude_deg\": -91")),
              HasSubstr("latitude"));
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "0.05", "0.9")), HasSubstr("reflectances"));
  EXPECT_THAT(Refusal(R"({"marker": {"family": "tag99h9"}})"),
              HasSubstr("scene.json: \"marker.family\" is unknown: \"tag99h9\""));
  EXPECT_THAT(Refusal(R"({"camera_response": 5})"), HasSubstr("\"camera_response\" is not a text"));
  EXPECT_THAT(Refusal(R"({"virtual_object": {"file": "a.obj", "shading": "shiny"}})"),
              HasSubstr("\"virtual_object.shading\" is not known"));
  EXPECT_THAT(Refusal(R"({"virtual_object": {"file": "a.obj\u0000.txt"}})"), HasSubstr("a NUL"));
  EXPECT_THAT(Refusal("[]"), HasSubstr("where the recording was made"));
}

TEST(SceneJson, FileCutShortSaysSo) {
  const std::string whole = tests::Content(tests::Courtyard() / "scene.json");
  for (const std::size_t length : {std::size_t{1}, whole.size() / 3, whole.size() - 2}) {
    EXPECT_THAT(Refusal(whole.substr(0, length)), HasSubstr("cut short")) << length;
  }
}

TEST(SceneFacts, FallbackFillsGapsButNeverBringsModels) {
  SceneFacts recorded;
  recorded.place_time.latitude_deg = 50;
  recorded.marker.size_m = 0.48;
  recorded.marker.id = 3;
  recorded.marker.board_size_m = 0.6;
  recorded.objects.emplace_back().file = "object.obj";
  SceneFacts by_hand;
  by_hand.place_time.latitude_deg = 10;
  const SceneFacts both = WithFallback(by_hand, recorded);
  EXPECT_EQ(both.place_time.latitude_deg, 10);
  EXPECT_EQ(both.marker.size_m, 0.48);
  EXPECT_EQ(both.marker.id, 3);
  EXPECT_TRUE(both.objects.empty());
  // A different sheet: the white margin and id of the recorded one do not apply.
  by_hand.marker.size_m = 0.1;
  EXPECT_FALSE(WithFallback(by_hand, recorded).marker.board_size_m);
  EXPECT_FALSE(WithFallback(by_hand, recorded).marker.id);
}

}  // namespace
}  // namespace pleinair::scene
