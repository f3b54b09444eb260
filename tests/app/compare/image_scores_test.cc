#include "app/compare/image_scores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pleinair::app {
namespace {

RgbImage Grey(std::uint8_t code, int width = 64, int height = 48) {
  RgbImage image(width, height, 3);
  std::fill_n(image.data(), image.size(), code);
  return image;
}

/// The object covers the left half and casts no shadow.
PictureRegions LeftHalf(int width = 64, int height = 48) {
  PictureRegions regions{{width, height}, {width, height}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width / 2; ++x) regions.object(x, y) = 255;
  }
  return regions;
}

TEST(PictureScores, GiveEqualPicturesFullMarks) {
  const RgbImage picture = Grey(100);
  const PictureScores scores = ScorePicture(picture.view(), picture.view(), LeftHalf());
  EXPECT_NEAR(scores.psnr, 108.13, 0.01);  // The squared difference is clamped to at least 1e-6.
  EXPECT_NEAR(scores.ssim, 1.0, 1e-12);
  EXPECT_EQ(scores.color_object, 0.0);
  EXPECT_EQ(scores.color_all, 0.0);
}

TEST(PictureScores, MeasureAnEvenStepOfGrey) {
  // A difference of 10 everywhere: 20 log10(255/10) dB. Only SSIM's luminance term changes.
  const PictureScores scores = ScorePicture(Grey(110).view(), Grey(100).view(), {});
  EXPECT_NEAR(scores.psnr, 28.1308, 1e-3);
  EXPECT_NEAR(scores.ssim, (2 * 100.0 * 110 + 6.5025) / (100.0 * 100 + 110 * 110 + 6.5025), 1e-6);
  EXPECT_TRUE(std::isnan(scores.color_object));
  EXPECT_TRUE(std::isnan(scores.psnr_near));
}

TEST(PictureScores, LookAtObjectShadowAndSurroundingsApart) {
  RgbImage truth = Grey(100, 200, 60), picture = Grey(100, 200, 60);
  PictureRegions regions{{200, 60}, {200, 60}};
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 200; ++x) {
      regions.object(x, y) = x < 20 ? 255 : x < 25 ? 127 : 0;  // Half covered: not object.
      regions.shadow(x, y) = x >= 30 && x < 40 ? 128 : 0;
      for (int c = 0; c < 3; ++c) {
        if (x >= 30 && x < 40) picture(x, y, c) = 110;  // An error in the shadow,
        if (x >= 120) picture(x, y, c) = 140;           // and an error far away.
      }
    }
  }
  const PictureScores scores = ScorePicture(picture.view(), truth.view(), regions);
  EXPECT_EQ(scores.color_object, 0.0);
  EXPECT_GT(scores.color_shadow, 2.0);
  // Columns 0 to 64: ten of the 65 lie in the shadow.
  EXPECT_NEAR(scores.color_near, scores.color_shadow * 10 / 65, 1e-9);
  EXPECT_GT(scores.color_all, scores.color_near);
}

TEST(PictureScores, MeanLeavesOutWhatNobodyKnows) {
  PictureScores one, two;
  one.psnr = 30;
  two.psnr = 40;
  one.color_object = 2;
  const PictureScores both[] = {one, two};
  const PictureScores mean = MeanOf(both, 2);
  EXPECT_EQ(mean.psnr, 35);
  EXPECT_EQ(mean.color_object, 2);
  EXPECT_TRUE(std::isnan(mean.color_shadow));
}

TEST(PictureScores, ShowNoDifferenceBlackAndALargeOneWhite) {
  const RgbImage none = DifferencePicture(Grey(90).view(), Grey(90).view());
  EXPECT_EQ(*std::max_element(none.data(), none.data() + none.size()), 0);
  const RgbImage large = DifferencePicture(Grey(0).view(), Grey(255).view());
  EXPECT_EQ(*std::min_element(large.data(), large.data() + large.size()), 255);
}

}  // namespace
}  // namespace pleinair::app
