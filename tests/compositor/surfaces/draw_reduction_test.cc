#include "compositor/surfaces/draw_reduction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pleinair::compositor {
namespace {

using ::testing::ElementsAre;

constexpr glm::vec3 kUp(0.0F, 0.0F, 1.0F);
// A square of 4 m perpendicular to a sun overhead, and its light.
const SunOnPhantoms kSun{
    {{1.0F, 0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F, 0.0F}, 4.0F, kUp}, false, glm::vec3(4000.0F)};

/// Triangles of half a metre at intervals of one metre along x, all facing up.
LitMesh Row(std::size_t triangles, float height_m) {
  LitMesh mesh;
  for (std::size_t i = 0; i < triangles; ++i) {
    const auto x = static_cast<float>(i);
    for (const auto& [dx, dy] : {std::pair{0.0F, 0.0F}, {0.5F, 0.0F}, {0.0F, 0.5F}}) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back({x + dx, dy, height_m});
      mesh.normals.push_back({0.0F, 0.0F, 1.0F});
      mesh.ambient_without.push_back({1000.0F, 1000.0F, 1000.0F});
      mesh.ambient_with.push_back(mesh.ambient_without.back());
    }
  }
  return mesh;
}

/// Four triangles of a phantom. An object is above the first. The skylight changes on the second,
/// which phantoms leave fully sunlit, and on the third, whose sun visibility is partial. Nothing
/// changes on the last.
class Scene {
 public:
  explicit Scene(const DrawReductions& reductions) {
    reduction_.Use(reductions);
    LitMesh phantom = Row(4, 0.0F);
    for (std::size_t i = 3; i < 9; ++i) phantom.ambient_with[i] = {900.0F, 900.0F, 900.0F};
    phantom.sunlight.to_sun = {0.0F, 0.0F, 1.0F};
    phantom.sunlight.by_triangle = {SunVisibility::kSome, SunVisibility::kAll, SunVisibility::kSome,
                                    SunVisibility::kSome};
    reduction_.AddPhantom(phantom);
    LitMesh object = Row(2, 1.0F);
    object.ambient_without.clear();
    object.positions[3] = object.positions[4] = object.positions[5] = object.positions[0];
    for (std::size_t i = 3; i < 6; ++i) object.normals[i] = {0.0F, 0.0F, -1.0F};
    reduction_.AddObject(object);
    const std::vector<glm::mat4> stays{glm::mat4(1.0F)};
    EXPECT_FALSE(reduction_.AreSortedFor(kSun));
    reduction_.SortPhantoms(kSun, stays);
    EXPECT_TRUE(reduction_.AreSortedFor(kSun));
    reduction_.SortObject(0, kUp);
  }

  /// Cumulative number of phantom triangles for each AffectedTriangles::Change.
  std::vector<int> ends() const {
    std::vector<int> triangles;
    for (const int end : reduction_.phantoms()[0].ends()) triangles.push_back(end / 3);
    return triangles;
  }
  std::size_t linear_ratios() const { return reduction_.phantoms()[0].linear_ratios().size(); }
  int facing() const { return reduction_.objects()[0].facing_end() / 3; }
  /// Tiles of an image of four by two tiles, one a metre, with the origin in the second row.
  AffectedTiles tiles(bool resolves_sunlit_sky = false) const {
    SceneProjection image{.width = 256, .height = 128, .near_m = 0.1F};
    image.clip_from_position = {{0.5F, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}, {-0.95F, 0.25F, 0, 1}};
    image.resolves_sunlit_sky = resolves_sunlit_sky;
    return reduction_.TilesOf(image, std::vector<glm::mat4>{glm::mat4(1.0F)});
  }

 private:
  DrawReduction reduction_;
};

TEST(DrawReduction, DrawsTheTilesOfObjectsAndOfWhatTheyAffect) {
  const AffectedTiles tiles = Scene({}).tiles();
  EXPECT_THAT(tiles.objects.Rectangles(), ElementsAre(PixelRect{0, 64, 64, 64}));
  EXPECT_THAT(tiles.all.Rectangles(), ElementsAre(PixelRect{0, 64, 192, 64}))
      << "nothing changes on the last triangle";
  EXPECT_THAT(tiles.fine.Rectangles(), ElementsAre(PixelRect{0, 64, 64, 64}))
      << "where the sunlight may change";
  EXPECT_THAT(Scene({}).tiles(true).fine.Rectangles(), ElementsAre(PixelRect{0, 64, 192, 64}));
}

Scene Without(bool DrawReductions::*reduction) {
  DrawReductions others;
  others.*reduction = false;
  return Scene(others);
}

TEST(DrawReduction, SortsTrianglesByTheShadingThatTheyNeed) {
  const Scene scene{DrawReductions()};
  EXPECT_THAT(scene.ends(), ElementsAre(1, 2, 3, 4)) << "shadow, sky, linear sky, nothing";
  EXPECT_EQ(scene.linear_ratios(), 1U);
  EXPECT_EQ(scene.facing(), 1);
}

TEST(DrawReduction, DrawsEverythingWithoutReductions) {
  const Scene scene{DrawReductions::None()};
  EXPECT_THAT(scene.ends(), ElementsAre(4, 4, 4, 4));
  EXPECT_EQ(scene.linear_ratios(), 0U);
  EXPECT_EQ(scene.facing(), 2);
}

TEST(DrawReduction, SwitchesEachReductionOffByItself) {
  EXPECT_EQ(Without(&DrawReductions::affected_triangles).ends()[AffectedTriangles::kLinearSky], 4)
      << "the last is shaded, too";
  EXPECT_EQ(Without(&DrawReductions::sun_footprint).ends()[AffectedTriangles::kSun], 4)
      << "all that lie in the sun's window";
  EXPECT_EQ(Without(&DrawReductions::sun_visibility).linear_ratios(), 0U)
      << "the second is not known to be sunlit";
  EXPECT_EQ(Without(&DrawReductions::linear_shadow_ratio).linear_ratios(), 0U);
  EXPECT_THAT(Without(&DrawReductions::linear_shadow_ratio).ends(), ElementsAre(1, 3, 3, 4));
  EXPECT_EQ(Without(&DrawReductions::sun_facing_triangles).facing(), 2);
  const AffectedTiles tiles = Without(&DrawReductions::affected_tiles).tiles();
  EXPECT_THAT(tiles.objects.Rectangles(), ElementsAre(PixelRect{0, 0, 256, 128}));
  EXPECT_THAT(tiles.fine.Rectangles(), ElementsAre(PixelRect{0, 0, 256, 128}));
  EXPECT_THAT(tiles.all.Rectangles(), ElementsAre(PixelRect{0, 0, 256, 128}));
  EXPECT_THAT(Without(&DrawReductions::coarse_sky_ratio).tiles().fine.Rectangles(),
              ElementsAre(PixelRect{0, 64, 192, 64}));
}

}  // namespace
}  // namespace pleinair::compositor
