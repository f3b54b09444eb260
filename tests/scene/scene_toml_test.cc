#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/scene_description.h"
#include "scene/scene_facts.h"
#include "tests/temporary_folder.h"

namespace pleinair::scene {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
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
up = "y"
unit = "ft"
origin = "bottom centre"
animation = "Walk"
animation_start_s = 1.5
loop = true
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
  EXPECT_EQ(scene->camera.exposure_scale, (LinearRgb{0.03, 0.035, 0.04}));
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
  EXPECT_EQ(scene->objects[0].up, UpAxis::kY);
  EXPECT_EQ(scene->objects[0].unit_m, 0.3048);
  EXPECT_EQ(scene->objects[0].origin, ModelOrigin::kBottomCentre);
  EXPECT_EQ(scene->objects[0].animation, "Walk");
  EXPECT_EQ(scene->objects[0].animation_start_s, 1.5);
  EXPECT_TRUE(scene->objects[0].loop);
  EXPECT_EQ(scene->phantoms[1].up, std::nullopt);
  EXPECT_EQ(scene->phantoms[1].unit_m, std::nullopt);
  EXPECT_EQ(scene->phantoms[1].origin, ModelOrigin::kFile);
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
  EXPECT_FALSE(scene->camera.exposure_scale);
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
  EXPECT_THAT(Refusal(tests::Replaced(kScene, "scale", "size")), HasSubstr("scene.toml:35"));
}

TEST(SceneToml, LocalTimeIsRefused) {
  for (const char* time :
       {"2025-09-14T11:05:00", "\"2025-09-14T11:05:00\"", "2025-09-14", "11:05:00", "1757847900"}) {
    EXPECT_THAT(Refusal(tests::Replaced(kScene, "2025-09-14T13:05:00+02:00", time)),
                AllOf(HasSubstr("scene.toml:1: \"time\""),
                      AnyOf(HasSubstr("RFC 3339"), HasSubstr("11:05:00+02:00, or Z for UTC"))))
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
  EXPECT_THAT(with("14.4213", "181"), HasSubstr("longitude_deg is 181, outside -180 to 180"));
  EXPECT_THAT(with("220", "1e9"), HasSubstr("height"));
  EXPECT_THAT(with("size_mm = 480", "size_mm = 0"),
              HasSubstr("marker.size_m is 0, outside 0.0001 to 1000"));
  EXPECT_THAT(with("size_mm = 480", "size_mm = 1e9"), HasSubstr("marker.size_m is 1e+06"));
  EXPECT_THAT(with("size_mm = 480", "size_mm = inf"), HasSubstr("is not finite"));
  EXPECT_THAT(with("board_size_mm = 600", "board_size_mm = 400"), HasSubstr("smaller than its"));
  EXPECT_THAT(with("heading_deg = 342", "heading_deg = 720"), HasSubstr("heading"));
  EXPECT_THAT(with("turbidity = 3.5", "turbidity = 0"), HasSubstr("turbidity"));
  EXPECT_THAT(with("[0.03, 0.035, 0.04]", "[0.03, 0, 0.04]"), HasSubstr("exposure_gain of 0"));
  EXPECT_THAT(with("[0.03, 0.035, 0.04]", "[0.03, 0.04]"), HasSubstr("three numbers"));
  EXPECT_THAT(with("scale = 0.001", "scale = 0"), HasSubstr("by 0, outside 1e-09 to 1e+09"));
  EXPECT_THAT(with("id = 7", "id = -7"), HasSubstr("whole number from 0 up"));
  EXPECT_THAT(with("[1, 2.5, 0]", "[1, 2.5, 1e30]"), HasSubstr("million metres"));
  EXPECT_THAT(with("\"smooth\"", "\"shiny\""), HasSubstr("known are file, flat and smooth"));
  EXPECT_THAT(with("models/wall.obj", "models/wall.obj\\u0000x"), HasSubstr("holds a NUL"));
  EXPECT_THAT(with("up = \"y\"", "up = \"x\""), HasSubstr("known are y and z"));
  EXPECT_THAT(with("\"ft\"", "\"yd\""), HasSubstr("known are mm, cm, m, in and ft"));
  EXPECT_THAT(with("animation = \"Walk\"\n", ""), HasSubstr("needs an animation"));
  EXPECT_THAT(with("_start_s = 1.5", "_start_s = -0.5"), HasSubstr("before the animation's"));
  EXPECT_THAT(with("file = \"models/wall.obj\"", "file = \"models/wall.obj\"\nloop = true"),
              HasSubstr("is for objects"));
  EXPECT_THAT(with("\"bottom centre\"", "\"top\""), HasSubstr("known are file and bottom centre"));
  EXPECT_THAT(with("\"Hazy\"", "\"grey\""), HasSubstr("known are clear, hazy"));
}

TEST(SceneToml, HasLayersOfCloudsInPlaceOfTheWord) {
  const std::string text = std::string(kScene) + R"(
[[cloud_layer]]
kind = "cumulus"
cover = 0.4
wind_m_s = 8
wind_from_deg = -110
seed = -7
[[cloud_layer]]
kind = "cirrus"
)";
  const auto scene = CompleteScene(ParseSceneToml(text, "scene.toml").value(), "scene.toml");
  ASSERT_TRUE(scene) << scene.error().Message();
  ASSERT_EQ(scene->clouds.layers.size(), 2U);
  const clouds::CloudLayer& cumulus = scene->clouds.layers[0];
  EXPECT_EQ(cumulus.cover, 0.4);
  EXPECT_EQ(cumulus.optical_depth, 20.0);
  EXPECT_EQ(cumulus.wind_from_deg, -110.0);
  EXPECT_EQ(cumulus.seed, -7);
  EXPECT_EQ(scene->clouds.layers[1].base_m, 8000.0);
  EXPECT_EQ(scene->cloudiness, Cloudiness::kClear);
  EXPECT_EQ(scene->clouds.ignored_word, Cloudiness::kHazy);
}

TEST(SceneToml, LayersOfCloudsMustBePossible) {
  const auto with = [](const std::string& layer) {
    return Refusal(std::string(kScene) + "[[cloud_layer]]\n" + layer);
  };
  const std::string cumulus = "kind = \"cumulus\"\n";
  EXPECT_EQ(with(cumulus), "no error");
  EXPECT_THAT(with("cover = 0.5\n"), HasSubstr("has no kind"));
  EXPECT_THAT(with("kind = \"fog\"\n"), HasSubstr("choose among cumulus"));
  EXPECT_THAT(with(cumulus + "height_m = 3\n"), HasSubstr("\"height_m\" is unknown"));
  EXPECT_THAT(with(cumulus + "cover = 1.5\n"),
              AllOf(HasSubstr("cover 1.5 is impossible"), HasSubstr("scene.toml:")));
  EXPECT_THAT(with("kind = \"slab\"\ncover = 0.5\n"), HasSubstr("impossible for a slab"));
  EXPECT_THAT(with(cumulus + "optical_depth = 201\n"), HasSubstr("from 0 to 200"));
  EXPECT_THAT(with(cumulus + "base_m = 49\n"), HasSubstr("base_m 49 is impossible"));
  EXPECT_THAT(with(cumulus + "cell_m = inf\n"), HasSubstr("is not finite"));
  EXPECT_THAT(with(cumulus + "wind_m_s = \"8\"\n"), HasSubstr("is not a number"));
  EXPECT_THAT(with(cumulus + "seed = 1.5\n"), HasSubstr("is not a whole number"));
  const std::string next = "[[cloud_layer]]\n" + cumulus;
  EXPECT_EQ(with(cumulus + next + next + next), "no error");
  EXPECT_THAT(with(cumulus + next + next + next + next), HasSubstr("keep 4 at most"));
}

TEST(SceneToml, LayersOfCloudsMayPassInStep) {
  const std::string layer =
      "[[cloud_layer]]\nkind = \"cumulus\"\nwind_m_s = 8\neast_m = 70\nnorth_m = -20\n";
  const std::string passing = "[cloud_layer.passing]\nwidth_m = 400\nnorth_m = -900\n";
  const std::string times = "seconds = [0, 2.5, 4]\n", shifts = "shifts = [-1, 0, 2.25]\n";
  const auto with = [&](const std::string& rest) {
    return Refusal(std::string(kScene) + layer + rest);
  };
  const auto scene = CompleteScene(
      ParseSceneToml(std::string(kScene) + layer + passing + times + shifts, "scene.toml").value(),
      "scene.toml");
  ASSERT_TRUE(scene) << scene.error().Message();
  const clouds::CloudLayer& found = scene->clouds.layers.at(0);
  EXPECT_EQ(found.east_m, 70.0);
  EXPECT_EQ(found.north_m, -20.0);
  EXPECT_EQ(found.passing.width_m, 400.0);
  EXPECT_EQ(found.passing.east_m, 0.0);
  EXPECT_EQ(found.passing.north_m, -900.0);
  EXPECT_EQ(found.passing.seconds, (std::vector<double>{0.0, 2.5, 4.0}));
  EXPECT_EQ(found.passing.shifts, (std::vector<double>{-1.0, 0.0, 2.25}));
  EXPECT_THAT(with(passing), HasSubstr("has no seconds"));
  EXPECT_THAT(with(passing + times), HasSubstr("3 seconds and 0 shifts"));
  EXPECT_THAT(with(passing + times + "shifts = [1, 2, \"3\"]\n"), HasSubstr("is not a number"));
  EXPECT_THAT(with(passing + "seconds = 3\n"), HasSubstr("is not a list of numbers"));
  EXPECT_THAT(with(passing + times + shifts + "depth = 3\n"), HasSubstr("\"depth\" is unknown"));
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

TEST(SceneToml, AnchorsAreFurtherMarkers) {
  const std::string scene =
      "time = 2025-09-14T13:05:00+02:00\n[place]\nlatitude_deg = 50\nlongitude_deg = 14\n"
      "[marker]\nid = 7\nsize_mm = 480\nheading_deg = 342\n";
  const tests::TemporaryFolder folder;
  const auto read = ReadSceneDescription(
      folder.Write("scene.toml", scene + "[[anchor]]\nid = 8\n"
                                         "[[anchor]]\nfamily = \"tag36h11\"\nid = 7\nsize_m = 0.2\n"
                                         "translation_m = [1, 2, 0]\nrotation_deg = [0, 0, 90]\n"));
  ASSERT_TRUE(read) << read.error().Message();
  ASSERT_EQ(read->anchors.size(), 2U);
  EXPECT_EQ(read->anchors[0].family, "sg");
  EXPECT_EQ(read->anchors[0].id, 8);
  EXPECT_EQ(read->anchors[0].size_m, 0.48);
  EXPECT_FALSE(read->anchors[0].place);
  EXPECT_EQ(read->anchors[1].family, "tag36h11");
  ASSERT_TRUE(read->anchors[1].place);
  EXPECT_EQ(read->anchors[1].place->translation_m.y, 2.0);
  EXPECT_EQ(read->anchors[1].place->rotation_deg.z, 90.0);

  EXPECT_THAT(Refusal(scene + "[[anchor]]\nsize_mm = 480\n"), HasSubstr("without an id"));
  EXPECT_THAT(Refusal(scene + "[[anchor]]\nid = 7\n"), HasSubstr("the marker sg 7 twice"));
  EXPECT_THAT(Refusal(scene + "[[anchor]]\nid = 8\n[[anchor]]\nid = 8\n"), HasSubstr("twice"));
  EXPECT_THAT(Refusal(scene + "[[anchor]]\nid = 8\nsize_mm = 0\n"), HasSubstr("impossible size"));
  EXPECT_THAT(Refusal(scene + "[[anchor]]\nid = 8\nrotation_deg = [0, 0, 1]\n"),
              HasSubstr("rotation_deg alone"));
  EXPECT_THAT(Refusal(scene + "[[anchor]]\nid = 8\ntranslation_m = [0, 0, 1e9]\n"),
              HasSubstr("beyond ten thousand"));
  EXPECT_THAT(Refusal(scene + "[[anchor]]\nid = 8\nheading_deg = 3\n"), HasSubstr("is unknown"));
  std::string unnumbered = scene + "[[anchor]]\nid = 8\n";
  unnumbered.erase(unnumbered.find("id = 7\n"), 7);
  EXPECT_THAT(Refusal(unnumbered), HasSubstr("marker.id"));
}

TEST(SceneToml, OneMarkerAnchorsTheScene) {
  EXPECT_EQ(Refusal(tests::Replaced(kScene, "[marker]", "[[marker]]")), "no error");
  EXPECT_THAT(Refusal(tests::Replaced(tests::Replaced(kScene, "[marker]", "[[marker]]"),
                                      "[[phantom]]", "[[marker]]\nsize_mm = 100\n[[phantom]]")),
              HasSubstr("given more than once"));
}

constexpr const char* kLeaves = R"(
[[leaf]]
materials = ["blade", "leaf_*"]
spad = 42
carotenoids_ug_cm2 = 9
water_cm = 0.012
gloss = 2
pigment_map = "maps/pigment.png"
[[leaf.stage]]
date = 2025-05-01
chlorophyll_ug_cm2 = 40
[[leaf.stage]]
date = 2025-05-11
chlorophyll_ug_cm2 = 20
dry_g_cm2 = 0.01
[[leaf]]
materials = ["old"]
model = "plate"
)";

TEST(SceneToml, ReadsLeavesAndTheirStages) {
  const tests::TemporaryFolder folder;
  WriteModels(folder);
  const auto scene =
      ReadSceneDescription(folder.Write("scene.toml", std::string(kScene) + kLeaves));
  ASSERT_TRUE(scene) << scene.error().Message();
  ASSERT_EQ(scene->leaves.size(), 2U);
  const LeafDescription& leaf = scene->leaves[0];
  EXPECT_THAT(leaf.materials, ::testing::ElementsAre("blade", "leaf_*"));
  EXPECT_NEAR(leaf.leaf.contents.chlorophyll_ug_cm2, 44.0, 0.1);  // Markwell et al. 1995.
  EXPECT_EQ(leaf.gloss, 2.0);
  EXPECT_EQ(leaf.roughness, 0.35);
  EXPECT_THAT(leaf.maps.pigment.string(), ::testing::EndsWith("maps/pigment.png"));
  EXPECT_EQ(scene->leaves[1].leaf.model, LeafModel::kPlate);
  // Held before and after the stages, linear between them; other keys are the leaf's.
  const auto at = [&](const char* time) { return LeafAt(leaf, *UtcTime::Parse(time)).contents; };
  EXPECT_EQ(at("2024-01-01T00:00:00Z").chlorophyll_ug_cm2, 40.0);
  EXPECT_NEAR(at("2025-05-06T00:00:00Z").chlorophyll_ug_cm2, 30.0, 1e-9);
  EXPECT_NEAR(at("2025-05-06T00:00:00Z").dry_g_cm2, 0.005, 1e-12);
  EXPECT_EQ(at("2025-12-01T00:00:00Z").chlorophyll_ug_cm2, 20.0);
  EXPECT_EQ(at("2025-12-01T00:00:00Z").carotenoids_ug_cm2, 9.0);
}

TEST(SceneToml, RefusesImpossibleLeavesByLineAndKey) {
  const auto refusal = [](const std::string& keys) {
    return Refusal(std::string(kScene) + "[[leaf]]\nmaterials = [\"a\"]\n" + keys);
  };
  EXPECT_THAT(refusal("dry_g_cm2 = 20\n"),
              AllOf(HasSubstr("scene.toml:38: dry_g_cm2 is 20: 0 to 0.05 g/cm²; milligrams?")));
  EXPECT_THAT(refusal("chlorophyll_ug_cm2 = nan\n"), HasSubstr("is not finite"));
  EXPECT_THAT(refusal("structure = 0.9\n"), HasSubstr("structure is 0.9: 1 to 4"));
  EXPECT_THAT(refusal("roughness = 0\n"), HasSubstr("\"roughness\" is 0: 0.05 to 1"));
  EXPECT_THAT(refusal("spad = 40\nchlorophyll_ug_cm2 = 40\n"),
              HasSubstr("\"spad\" is given beside chlorophyll_ug_cm2"));
  EXPECT_THAT(refusal("model = \"cube\"\n"), HasSubstr("known are prospect-d and plate"));
  EXPECT_THAT(refusal("pigments = 3\n"), HasSubstr("\"pigments\" is unknown"));
  EXPECT_THAT(refusal("[[leaf.stage]]\nbrown = 1\n"), HasSubstr("has no date"));
  EXPECT_THAT(refusal("[[leaf.stage]]\ndate = 2025-02-01\n[[leaf.stage]]\ndate = 2025-01-01\n"),
              HasSubstr("is not after that of the stage before"));
  EXPECT_THAT(Refusal(std::string(kScene) + "[[leaf]]\nbrown = 1\n"),
              HasSubstr("scene.toml:36: the table names no materials"));
}

}  // namespace
}  // namespace pleinair::scene
