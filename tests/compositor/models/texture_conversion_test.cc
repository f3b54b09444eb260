#include "compositor/models/texture_conversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace pleinair::compositor {
namespace {

TEST(NormalMapFromHeight, HasTheSlopesOfTheHeights) {
  // A ramp to the right of one 8-bit value a pixel, and one of two downwards.
  constexpr int kSide = 60;
  Image<std::uint8_t> heights(kSide, kSide, 3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) heights(x, y, 0) = static_cast<std::uint8_t>(x + 2 * y);
  }
  constexpr float kBump = 100.0F;  // White is as high as the picture is wide.
  const Image<std::uint8_t> map = NormalMapFromHeight(heights, kBump);
  const double slope = kSide / 255.0;  // Height a pixel.
  const double length = std::sqrt(slope * slope + 4 * slope * slope + 1.0);
  EXPECT_NEAR(map(30, 30, 0), 127.5 - 127.5 * slope / length, 1.0);
  EXPECT_NEAR(map(30, 30, 1), 127.5 + 127.5 * 2 * slope / length, 1.0) << "it falls upwards";
  EXPECT_NEAR(map(30, 30, 2), 127.5 + 127.5 / length, 1.0);
  EXPECT_TRUE(LooksLikeNormalMap(NormalMapFromHeight(heights, 1.0F)));
  EXPECT_FALSE(LooksLikeNormalMap(heights));
}

TEST(CombinedRoughnessAndMetal, SamplesTheSmallerPicture) {
  Image<std::uint8_t> roughness(4, 2, 3), metal(2, 1, 3);
  roughness(3, 1, 0) = 7;
  metal(1, 0, 0) = 200;
  const Image<std::uint8_t> both = CombinedRoughnessAndMetal(roughness, metal);
  ASSERT_EQ(both.width(), 4);
  EXPECT_EQ(both(3, 1, 1), 7);
  EXPECT_EQ(both(2, 1, 2), 200);
  EXPECT_EQ(both(1, 1, 2), 0);
  EXPECT_EQ(CombinedRoughnessAndMetal({}, metal)(0, 0, 1), 255);
}

}  // namespace
}  // namespace pleinair::compositor
