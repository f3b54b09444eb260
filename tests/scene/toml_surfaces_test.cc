// Ground, boxes and walls that a scene describes without a model.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/described_surface.h"
#include "scene/scene_description.h"
#include "tests/temporary_folder.h"

namespace pleinair::scene {
namespace {

using ::testing::HasSubstr;

std::string RefusalOfSurfaces(std::string_view toml) {
  const tests::TemporaryFolder folder;
  return tests::MessageOf(ReadSceneDescription(folder.Write("scene.toml", toml)));
}

constexpr const char* kBare = R"(time = 2025-09-14T13:05:00+02:00
place = {latitude_deg = 50, longitude_deg = 14}
marker = {size_mm = 480, heading_deg = 0}
)";

/// Phantoms of kBare with further lines.
std::vector<ModelReference> PhantomsWith(const std::string& lines, const char* scene = kBare) {
  const tests::TemporaryFolder folder;
  const auto read = ReadSceneDescription(folder.Write("scene.toml", scene + lines));
  EXPECT_TRUE(read) << read.error().Message();
  return read ? read->phantoms : std::vector<ModelReference>();
}

TEST(TomlSurfaces, SurfacesNeedNoModel) {
  const auto phantoms = PhantomsWith(R"(
[ground]
size_m = 8
height_m = 0.01
color = [0.1, 0.2, 0.3]
[[box]]
from_m = [1, 2, 0]
to_m = [0, 4, 0.5]
translation_m = [0, 0, 0.1]
[[wall]]
corners_m = [[2, 0, 0], [2, 3, 0], [2, 3, 2.5], [2, 0, 2.5]]
)");
  ASSERT_EQ(phantoms.size(), 3U);
  const DescribedSurface& box = phantoms[0].surface.value();
  EXPECT_EQ(box.name, "box 1");
  ASSERT_EQ(box.polygons.size(), 6U);
  EXPECT_EQ(phantoms[0].translation_m.z, 0.1);
  // Normals outwards: the divergence theorem gives the volume, 1 x 2 x 0.5.
  double volume = 0.0;
  for (const auto& face : box.polygons) {
    ASSERT_EQ(face.size(), 4U);
    volume += (Dot(face[0], Cross(face[1], face[2])) + Dot(face[0], Cross(face[2], face[3]))) / 6;
  }
  EXPECT_NEAR(volume, 1.0, 1e-12);
  EXPECT_EQ(phantoms[1].surface->name, "wall 1");
  EXPECT_EQ(phantoms[1].surface->reflectance, kUsualReflectance);
  EXPECT_FALSE(phantoms[1].surface->has_color);
  const DescribedSurface& ground = phantoms[2].surface.value();
  EXPECT_EQ(ground.reflectance, (LinearRgb{0.1, 0.2, 0.3}));
  const auto& corners = ground.polygons.at(0);
  EXPECT_EQ(corners[0], (Vec3{-4, -4, -0.01}));
  EXPECT_GT(Cross(corners[1] - corners[0], corners[2] - corners[1]).z, 0.0);
  EXPECT_FALSE(ground.is_assumed);
  EXPECT_TRUE(ground.has_color);
  EXPECT_FALSE(PhantomsWith("[ground]\ncolor = \"measured\"\n").at(0).surface->has_color);
}

TEST(TomlSurfaces, LevelGroundIsAssumedBelowALyingMarkerAlone) {
  EXPECT_TRUE(PhantomsWith("").at(0).surface->is_assumed);
  EXPECT_TRUE(PhantomsWith(std::string("ground = false\n") + kBare, "").empty());
  EXPECT_EQ(PhantomsWith("[[wall]]\ncorners_m = [[0, 0, 0], [1, 0, 0], [0, 0, 1]]\n").size(), 1U);
  const std::string upright = R"(time = 2025-09-14T13:05:00+02:00
place = {latitude_deg = 50, longitude_deg = 14}
marker = {size_mm = 480, heading_deg = 0, upright = true}
)";
  EXPECT_TRUE(PhantomsWith("", upright.c_str()).empty());
  const auto floor = PhantomsWith("[ground]\nheight_m = 1.5\n", upright.c_str());
  ASSERT_EQ(floor.size(), 1U);
  const auto& corners = floor[0].surface->polygons.at(0);
  for (const Vec3& corner : corners) EXPECT_EQ(corner.y, -1.5);
  EXPECT_GT(Cross(corners[1] - corners[0], corners[2] - corners[1]).y, 0.0);
}

TEST(TomlSurfaces, ImpossibleSurfacesAreRefused) {
  const auto refusal = [](const std::string& lines) { return RefusalOfSurfaces(kBare + lines); };
  EXPECT_THAT(refusal("[[box]]\nfrom_m = [0, 0, 0]\n"), HasSubstr("box 1 lacks a corner"));
  EXPECT_THAT(refusal("[[box]]\nfrom_m = [0, 0, 0]\nto_m = [1, 1, 0]\n"),
              HasSubstr("differ in fewer than three"));
  const auto wall = [&](const std::string& corners) {
    return refusal("[[wall]]\ncorners_m = [" + corners + "]\n");
  };
  EXPECT_THAT(wall("[0, 0, 0], [1, 0, 0]"), HasSubstr("wall 1 has 2 corners"));
  EXPECT_THAT(wall("[0, 0, 0], [1, 0, 0], [2, 0, 0]"), HasSubstr("on one line"));
  EXPECT_THAT(wall("[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]"), HasSubstr("one plane"));
  EXPECT_THAT(wall("[0, 0, 0], [2, 0, 0], [0.3, 0.3, 0], [0, 2, 0]"), HasSubstr("a dent"));
  EXPECT_THAT(wall("[0, 0, 0], [0, 0, 0], [1, 0, 0], [0, 1, 0]"), HasSubstr("at one place"));
  EXPECT_THAT(wall("[0, 0, 0], 7, [0, 1, 0]"), HasSubstr("list of three numbers"));
  EXPECT_THAT(wall("[0, 0, 0], [1e7, 0, 0], [0, 1, 0]"), HasSubstr("million metres"));
  EXPECT_THAT(refusal("[ground]\nsize_m = -3\n"), HasSubstr("impossible size"));
  EXPECT_THAT(refusal("[ground]\ncolor = [2, 0, 0]\n"), HasSubstr("color outside 0 to 1"));
  EXPECT_THAT(refusal("[ground]\ncolor = \"green\"\n"), HasSubstr("\"measured\""));
  EXPECT_THAT(refusal("[ground]\nsiez_m = 3\n"), HasSubstr("\"siez_m\" is unknown"));
}

}  // namespace
}  // namespace pleinair::scene
