#include "base/image.h"

#include <gtest/gtest.h>

namespace pleinair {
namespace {

TEST(Image, ChannelsInterleaveAndRowsFollowWithoutPadding) {
  RgbImage image(3, 2, 3);
  image(2, 1, 1) = 77;
  EXPECT_EQ(image.size(), 18U);
  EXPECT_EQ(image.data()[(1 * 3 + 2) * 3 + 1], 77);
}

TEST(Image, StartsBlack) {
  const GreyImage image(4, 4);
  for (std::size_t i = 0; i < image.size(); ++i) EXPECT_EQ(image.data()[i], 0);
}

TEST(ImageView, SeesAPartOfALargerPictureByItsStride) {
  GreyImage image(10, 10);
  ImageView<std::uint8_t> part(image.data() + 2 * 10 + 3, 4, 5, 1, 10);
  part(3, 4) = 9;
  EXPECT_EQ(image(6, 6), 9);
  const ImageView<const std::uint8_t> constant = part;
  EXPECT_EQ(constant(3, 4), 9);
}

TEST(ImageDeathTest, NegativeSizeBreaksAnInvariant) {
  EXPECT_DEATH(GreyImage(1, -1), "CHECK failed: height >= 0 \\(-1 vs. 0\\)");
}

}  // namespace
}  // namespace pleinair
