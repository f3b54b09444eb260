#include "compositor/surfaces/image_tiles.h"

#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace pleinair::compositor {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// 200 × 150 pixels, four by three tiles; positions are pixels, at a depth of 1 m.
SceneProjection Flat() {
  SceneProjection image{.width = 200, .height = 150, .near_m = 0.1F};
  image.clip_from_position = glm::mat4(1.0F);
  image.clip_from_position[0] = {2.0F / 200, 0, 0, 0};
  image.clip_from_position[1] = {0, 2.0F / 150, 0, 0};
  image.clip_from_position[3] = {-1, -1, 0, 1};
  return image;
}

std::vector<PixelRect> TilesOf(const SceneProjection& image,
                               const std::array<glm::vec3, 3>& triangle) {
  ImageTiles tiles(image);
  tiles.Include(image, triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  return tiles.Rectangles();
}

TEST(ImageTiles, AreThoseThatATriangleTouches) {
  SceneProjection image = Flat();
  EXPECT_THAT(TilesOf(image, {{{70, 10, 0}, {80, 10, 0}, {70, 20, 0}}}),
              ElementsAre(PixelRect{64, 0, 64, 64}));
  EXPECT_THAT(TilesOf(image, {{{70, 10, 0}, {140, 10, 0}, {70, 140, 0}}}),
              ElementsAre(PixelRect{64, 0, 128, 150}))
      << "cut at the image's edge";
  EXPECT_THAT(TilesOf(image, {{{300, 10, 0}, {310, 10, 0}, {300, 20, 0}}}), IsEmpty());
  image.spread_px = 10;
  EXPECT_THAT(TilesOf(image, {{{70, 10, 0}, {80, 10, 0}, {70, 20, 0}}}),
              ElementsAre(PixelRect{0, 0, 128, 64}))
      << "a blur reaches the tile beside it";
}

TEST(ImageTiles, AreAllWhereATriangleLiesNobodyKnowsWhere) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(TilesOf(Flat(), {{{nan, nan, 0}, {80, 10, 0}, {70, 20, 0}}}),
              ElementsAre(PixelRect{0, 0, 200, 150}));
}

TEST(ImageTiles, HoldEveryVisiblePointOfATriangle) {
  SceneProjection image{.width = 640, .height = 480, .near_m = 0.05F};
  image.clip_from_position = {{1.2F, 0, 0, 0}, {0, 1.6F, 0, 0}, {0, 0, 1, 1}, {0, 0, -0.1F, 0}};
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-1.5F, 1.5F), share(0.0F, 1.0F);
  int visible = 0, beside = 0;
  for (int i = 0; i < 300; ++i) {
    std::array<glm::vec3, 3> triangle{};
    for (glm::vec3& corner : triangle) corner = {place(random), place(random), place(random)};
    ImageTiles tiles(image);
    tiles.Include(image, triangle, std::array<std::uint32_t, 3>{0, 1, 2});
    beside += tiles.Rectangles() != std::vector{PixelRect{0, 0, 640, 480}} ? 1 : 0;
    for (int k = 0; k < 100; ++k) {
      const float b = share(random), c = (1.0F - b) * share(random);
      const glm::vec3 at = (1.0F - b - c) * triangle[0] + b * triangle[1] + c * triangle[2];
      const glm::vec4 clip = image.clip_from_position * glm::vec4(at, 1.0F);
      const glm::vec2 pixel =
          (0.5F * glm::vec2(clip) / clip.w + 0.5F) * glm::vec2(image.width, image.height);
      if (clip.w < image.near_m || !glm::all(glm::lessThan(pixel, glm::vec2(640, 480))) ||
          !glm::all(glm::greaterThan(pixel, glm::vec2(0.0F)))) {
        continue;
      }
      ++visible;
      EXPECT_TRUE(tiles.Touches(pixel, pixel)) << i;
    }
  }
  EXPECT_GT(visible, 1000);
  EXPECT_GT(beside, 100) << "not always all";
}

TEST(ImageTiles, AreChosenAmongOthers) {
  ImageTiles tiles(200, 150), others(200, 150);
  tiles.Include({10, 10}, {150, 20});
  others.Include({70, 10}, {80, 140});
  EXPECT_EQ(tiles.Count(), 3);
  EXPECT_THAT(tiles.Without(others).Rectangles(),
              ElementsAre(PixelRect{0, 0, 64, 64}, PixelRect{128, 0, 64, 64}));
  tiles.IncludeAll();
  EXPECT_THAT(tiles.Where([](const PixelRect& tile) { return tile.width < 64 && tile.y == 128; })
                  .Rectangles(),
              ElementsAre(PixelRect{192, 128, 8, 22}));
}

TEST(ImageTiles, HaveDisjointRectanglesThatCoverThem) {
  ImageTiles tiles(640, 480);
  EXPECT_EQ(tiles.Bounds(), PixelRect{});
  std::mt19937 random(7);
  std::uniform_real_distribution<float> x(0.0F, 639.0F), y(0.0F, 479.0F);
  for (int i = 0; i < 25; ++i) {
    const glm::vec2 at(x(random), y(random));
    tiles.Include(at, at);
  }
  std::vector<int> covered(640 * 480, 0);
  for (const PixelRect& r : tiles.Rectangles()) {
    for (int v = r.y; v < r.y + r.height; ++v) {
      for (int u = r.x; u < r.x + r.width; ++u) ++covered[v * 640 + u];
    }
  }
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const glm::vec2 at(u + 0.5F, v + 0.5F);
      ASSERT_EQ(covered[v * 640 + u], tiles.Touches(at, at) ? 1 : 0) << u << " " << v;
    }
  }
  ImageTiles all(640, 480);
  all.IncludeAll();
  EXPECT_THAT(all.Rectangles(), ElementsAre(PixelRect{0, 0, 640, 480}));
  all = ImageTiles(640, 480);
  all.Include(tiles);
  EXPECT_EQ(all.Rectangles(), tiles.Rectangles());
}

}  // namespace
}  // namespace pleinair::compositor
