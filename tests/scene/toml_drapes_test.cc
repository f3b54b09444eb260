#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "scene/scene_description.h"
#include "tests/temporary_folder.h"

namespace pleinair::scene {
namespace {

using ::testing::HasSubstr;

constexpr const char* kBeforeDrape = R"(time = 2025-09-14T11:05:00Z
[place]
latitude_deg = 50.0875
longitude_deg = 14.4213
height_m = 265.5
height_reference = "ellipsoid"
[marker]
size_mm = 480
heading_deg = 342
offset_m = [1.5, -2.0, 0.25]
position_sd_m = 0.02
[[phantom]]
name = "meadow"
file = "ground.obj"
[[phantom]]
file = "bridge.obj"
[[box]]
from_m = [1, 1, 0]
to_m = [2, 2, 1]
[[drape]]
file = "maps/plan.gpkg"
)";

Result<SceneDescription> SceneWith(const std::string& drape_keys) {
  const tests::TemporaryFolder folder;
  for (const char* file : {"ground.obj", "bridge.obj", "maps/plan.gpkg"}) {
    folder.Write(file, "v 0 0 0\n");
  }
  auto scene = ReadSceneDescription(folder.Write("scene.toml", kBeforeDrape + drape_keys));
  if (scene) {
    EXPECT_EQ(scene->drapes.at(0).source.file, folder / "maps/plan.gpkg");
  }
  return scene;
}

TEST(Drapes, HaveEveryKey) {
  const auto scene = SceneWith(R"(layer = "parcels"
where = "status = 'new'"
crs = "EPSG:5514"
line_width_px = 2.5
color = "#d02010"
fill = "#2060D0"
opacity = 0.8
dash_m = [1.0, 0.5]
blend = "glow"
on = "meadow"
offset_m = -0.5
height_field = "depth"
hidden = "ghost"
live = "screen"
)");
  ASSERT_TRUE(scene) << scene.error().Message();
  EXPECT_TRUE(scene->place_time.above_ellipsoid);
  EXPECT_EQ(scene->marker.offset_m, (Vec3{1.5, -2.0, 0.25}));
  EXPECT_EQ(scene->marker.position_sd_m, 0.02);
  const DrapeDescription& drape = scene->drapes.at(0);
  EXPECT_EQ(drape.source.layer, "parcels");
  EXPECT_EQ(drape.source.where, "status = 'new'");
  EXPECT_EQ(drape.source.crs, "EPSG:5514");
  EXPECT_EQ(drape.ink.line_width, 2.5);
  EXPECT_TRUE(drape.ink.width_in_px);
  EXPECT_EQ(HexColor(drape.ink.color), "#d02010");
  // IEC 61966-2-1: 0x20 / 255 = 0.1255 is 0.0144 linear.
  EXPECT_NEAR(drape.ink.color.g, 0.01444, 1e-5);
  ASSERT_TRUE(drape.ink.fill);
  EXPECT_EQ(HexColor(*drape.ink.fill), "#2060d0");
  EXPECT_EQ(drape.ink.opacity, 0.8);
  EXPECT_EQ(drape.ink.dash_m, (std::array{1.0, 0.5}));
  EXPECT_EQ(drape.ink.blend, InkBlend::kGlow);
  EXPECT_EQ(drape.on, "meadow");
  EXPECT_EQ(drape.offset_m, -0.5);
  EXPECT_EQ(drape.height_field, "depth");
  EXPECT_EQ(drape.ink.hidden, HiddenInk::kGhost);
  EXPECT_EQ(drape.search, DrapeSearch::kScreen);
}

TEST(Drapes, NeedNothingButAFile) {
  const auto scene = SceneWith("");
  ASSERT_TRUE(scene) << scene.error().Message();
  const DrapeDescription& drape = scene->drapes.at(0);
  EXPECT_EQ(drape.ink.line_width, 0.15);
  EXPECT_FALSE(drape.ink.width_in_px);
  EXPECT_EQ(HexColor(drape.ink.color), "#d02010");
  EXPECT_FALSE(drape.ink.fill);
  EXPECT_FALSE(drape.ink.dash_m);
  EXPECT_EQ(drape.ink.opacity, 1.0);
  EXPECT_EQ(drape.ink.blend, InkBlend::kStain);
  EXPECT_EQ(drape.ink.hidden, HiddenInk::kHide);
  EXPECT_EQ(drape.on, "top");
  EXPECT_EQ(drape.offset_m, 0.0);
  EXPECT_TRUE(drape.height_field.empty());
  EXPECT_EQ(drape.search, DrapeSearch::kAuto);
}

TEST(Drapes, LieOnPhantomsByNameOrFileOrKind) {
  for (const char* on : {"top", "lowest", "meadow", "bridge", "box 1"}) {
    EXPECT_TRUE(SceneWith("on = \"" + std::string(on) + "\"\n")) << on;
  }
  EXPECT_THAT(tests::MessageOf(SceneWith("on = \"ground\"\n")),
              HasSubstr("scene.toml:22: \"on\" is \"ground\", which is no phantom; known are top, "
                        "lowest, meadow, bridge, box 1"));
}

TEST(Drapes, RefuseWhatIsNoValueWithItsLine) {
  const struct {
    const char *keys, *message;
  } kBad[] = {
      {"line_width_m = 0\n", "scene.toml:22: \"line_width_m\" is out of range"},
      {"line_width_px = 1001\n", "\"line_width_px\" is out of range"},
      {"line_width_m = 1\nline_width_px = 1\n", "are both given"},
      {"color = \"red\"\n", "\"color\" is no color"},
      {"color = \"#12345g\"\n", "\"color\" is no color"},
      {"color = \"#123456\"\ncolor_field = \"c\"\n", "are both given"},
      {"fill = \"#1234567\"\n", "\"fill\" is no color"},
      {"opacity = 1.1\n", "\"opacity\" is out of range"},
      {"dash_m = [1]\n", "\"dash_m\" is no dash and gap"},
      {"dash_m = [1, 0]\n", "\"dash_m\" is no dash and gap"},
      {"dash_m = []\n", "\"dash_m\" is no dash and gap"},
      {"blend = \"print\"\n", "known are stain, paint, glow"},
      {"hidden = \"show\"\n", "known are hide, ghost"},
      {"live = \"fast\"\n", "known are auto, exact, screen"},
      {"offset_m = 1e300\n", "\"offset_m\" is out of range"},
      {"offset_m = \"up\"\n", "is not a number"},
      {"height_field = \"z\"\non = \"lowest\"\n", "\"on\" has no meaning"},
      {"layer = \"\"\n", "\"layer\" is empty"},
      {"width = 1\n", "\"width\" is unknown"},
      {"[[drape]]\nlayer = \"roads\"\n", "scene.toml:22: the table has no file"},
      {"[[object]]\nfile = \"ground.obj\"\nname = \"tree\"\n", "\"name\" is for phantoms"},
      {"[[drape]]\nfile = \"none.gpkg\"\n", "names the map"},
  };
  for (const auto& bad : kBad) {
    EXPECT_THAT(tests::MessageOf(SceneWith(bad.keys)), HasSubstr(bad.message)) << bad.keys;
  }
  std::string many;
  for (int i = 0; i < 64; ++i) many += "[[drape]]\nfile = \"maps/plan.gpkg\"\n";
  EXPECT_THAT(tests::MessageOf(SceneWith(many)), HasSubstr("one [[drape]] too many"));
}

TEST(Drapes, ColorsAreTheNearestTextBothWays) {
  for (const char* text : {"#000000", "#ffffff", "#010203", "#7f80c4"}) {
    EXPECT_EQ(HexColor(*ParseHexColor(text)), text);
  }
}

}  // namespace
}  // namespace pleinair::scene
