// The scene of a recorded live session, read again.
#include <gtest/gtest.h>

#include <string>

#include "app/live/live_recorder.h"
#include "scene/scene_description.h"
#include "tests/temporary_folder.h"

namespace pleinair::app {
namespace {

constexpr const char* kScene = R"(time = 2025-09-14T11:05:00Z
[place]
latitude_deg = 50
longitude_deg = 14
height_m = 265.5
height_reference = "ellipsoid"
[marker]
size_mm = 480
heading_deg = 0
offset_m = [1.5, -2.0, 0.25]
position_sd_m = 0.02
[[phantom]]
name = "meadow"
file = "ground.obj"
[[drape]]
file = "plan.gpkg"
layer = "parcels"
where = "status = 'new'"
crs = "EPSG:5514"
line_width_px = 2.5
color = "#d02010"
fill = "#2060d0"
opacity = 0.8
dash_m = [1.0, 0.5]
blend = "glow"
on = "meadow"
offset_m = -0.5
height_field = "depth"
hidden = "ghost"
live = "screen"
[[drape]]
file = "plan.gpkg"
color_field = "colour"
height_field = "z"
)";

TEST(SceneTomlText, KeepsDrapesAndWhereTheMarkerIs) {
  const tests::TemporaryFolder folder;
  folder.Write("ground.obj", "v 0 0 0\n");
  folder.Write("plan.gpkg", "map");
  const auto first = scene::ReadSceneDescription(folder.Write("scene.toml", kScene));
  ASSERT_TRUE(first) << first.error().Message();
  const auto again = scene::ReadSceneDescription(
      folder.Write("again.toml", SceneToml(*first, first->place_time.start, folder.path())));
  ASSERT_TRUE(again) << again.error().Message();
  EXPECT_TRUE(again->place_time.above_ellipsoid);
  EXPECT_EQ(again->marker.offset_m, first->marker.offset_m);
  EXPECT_EQ(again->marker.position_sd_m, 0.02);
  EXPECT_EQ(again->phantoms.at(0).name, "meadow");
  ASSERT_EQ(again->drapes.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const scene::DrapeDescription &a = first->drapes[i], &b = again->drapes[i];
    EXPECT_EQ(a.source.file, b.source.file);
    EXPECT_EQ(a.source.layer, b.source.layer);
    EXPECT_EQ(a.source.where, b.source.where);
    EXPECT_EQ(a.source.crs, b.source.crs);
    EXPECT_EQ(a.ink.line_width, b.ink.line_width);
    EXPECT_EQ(a.ink.width_in_px, b.ink.width_in_px);
    EXPECT_EQ(scene::HexColor(a.ink.color), scene::HexColor(b.ink.color));
    EXPECT_EQ(a.ink.color_field, b.ink.color_field);
    EXPECT_EQ(a.ink.fill, b.ink.fill);
    EXPECT_EQ(a.ink.opacity, b.ink.opacity);
    EXPECT_EQ(a.ink.dash_m, b.ink.dash_m);
    EXPECT_EQ(a.ink.blend, b.ink.blend);
    EXPECT_EQ(a.ink.hidden, b.ink.hidden);
    EXPECT_EQ(a.on, b.on);
    EXPECT_EQ(a.offset_m, b.offset_m);
    EXPECT_EQ(a.height_field, b.height_field);
    EXPECT_EQ(a.search, b.search);
  }
}

}  // namespace
}  // namespace pleinair::app
