#include "base/pixel_origin.h"

#include <gtest/gtest.h>

namespace pleinair {
namespace {

TEST(PixelOrigin, CentreOfTheTopLeftPixelIsZeroHereAndOneHalfThere) {
  EXPECT_EQ(CornerOriginFromPixel({0, 0}), (Vec2{0.5, 0.5}));
  EXPECT_EQ(PixelFromCornerOrigin({0.5, 0.5}), (Vec2{0, 0}));
}

TEST(PixelOrigin, PictureIsOnePixelWiderThanItsOutermostCentresAreApart) {
  constexpr int kWidth = 640;
  EXPECT_EQ(PixelFromCornerOrigin({0, 0}).x, -0.5);
  EXPECT_EQ(PixelFromCornerOrigin({kWidth, 0}).x, kWidth - 0.5);
}

TEST(PixelOrigin, ConversionsUndoEachOther) {
  const Vec2 pixel{123.25, -7.75};
  EXPECT_EQ(PixelFromCornerOrigin(CornerOriginFromPixel(pixel)), pixel);
}

}  // namespace
}  // namespace pleinair
