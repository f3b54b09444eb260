#include "compositor/picture/occluder_mask.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pleinair::compositor {
namespace {

const CameraModel kSmallCamera{
    .width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 159.5, .cy = 119.5};
// A metre above a marker of 0.4 m, which is 120 pixels wide.
const Transform<Camera, Marker> kFromAMetreAbove{{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0, 0, 1}};
constexpr int kSquares = 12;

/// An arm from the image's right edge to the marker's centre.
bool IsArm(int x, int y) { return x > 160 && std::abs(y - 120) < 14; }

struct Scene {
  RgbImage picture{320, 240, 3};
  MarkerVisibility cover{kSquares, 0.4, std::vector<std::uint8_t>(kSquares* kSquares, 255)};
};

Scene Make(std::array<int, 3> arm, bool covered = true) {
  Scene scene;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const bool marker = std::abs(x - 160) < 60 && std::abs(y - 120) < 60;
      const int shade = ((x / 7 + y / 7) % 3) * 12;
      std::array<int, 3> color{110 + shade, 105 + shade, 95 + shade};
      if (marker)
        color = (x / 10 + y / 10) % 2 == 0 ? std::array{225, 225, 222} : std::array{45, 45, 46};
      if (covered && IsArm(x, y))
        color = {arm[0] + shade / 3, arm[1] + shade / 3, arm[2] + shade / 3};
      for (int c = 0; c < 3; ++c) scene.picture(x, y, c) = static_cast<std::uint8_t>(color[c]);
      if (!marker || !covered || !IsArm(x, y)) continue;
      const int column = (x - 100) * kSquares / 120, row = (y - 60) * kSquares / 120;
      scene.cover.seen[static_cast<std::size_t>(row) * kSquares + column] = 0;
    }
  }
  return scene;
}

TEST(OccluderMask, IsEmptyWhereNothingCoversTheMarker) {
  const Scene scene = Make({0, 0, 0}, false);
  EXPECT_TRUE(
      MaskOccluder(scene.picture.view(), kSmallCamera, kFromAMetreAbove, scene.cover).empty());
}

TEST(OccluderMask, FollowsAnArmByItsColorToThePicturesEdge) {
  const Scene scene = Make({190, 130, 100});
  const auto mask = MaskOccluder(scene.picture.view(), kSmallCamera, kFromAMetreAbove, scene.cover);
  ASSERT_FALSE(mask.empty());
  int wrong = 0, arm = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      arm += IsArm(x, y) ? 1 : 0;
      wrong += (mask(x, y) > 127) != IsArm(x, y) ? 1 : 0;
    }
  }
  EXPECT_LT(wrong, arm / 10);
  EXPECT_GT(mask(310, 120), 250);
  EXPECT_EQ(mask(310, 60), 0);
}

TEST(OccluderMask, StaysOnTheMarkerWhereColorTellsNothing) {
  // A glove as grey as the ground.
  const Scene scene = Make({112, 107, 97});
  const auto mask = MaskOccluder(scene.picture.view(), kSmallCamera, kFromAMetreAbove, scene.cover);
  ASSERT_FALSE(mask.empty());
  EXPECT_GT(mask(200, 120), 250);
  EXPECT_EQ(mask(270, 120), 0);
  EXPECT_EQ(mask(120, 160), 0);
}

TEST(OccluderMask, PutsTheFramesOwnPixelsInFront) {
  RgbImage background(2, 1, 3), composed(2, 1, 3);
  for (int c = 0; c < 3; ++c) {
    background(0, 0, c) = background(1, 0, c) = 200;
    composed(0, 0, c) = composed(1, 0, c) = 100;
  }
  Image<std::uint8_t> mask(2, 1);
  mask(0, 0) = 255;
  PutInFront(background.view(), mask, &composed);
  EXPECT_EQ(composed(0, 0, 1), 200);
  EXPECT_EQ(composed(1, 0, 1), 100);
}

}  // namespace
}  // namespace pleinair::compositor
