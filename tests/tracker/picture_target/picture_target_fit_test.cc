// Tests prediction and alignment of picture targets against brute force and the truth.
#include "tracker/picture_target/picture_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "tests/tracker/picture_target/picture_target_scenes.h"
#include "tests/tracker/surf_golay/sg_test_scenes.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

constexpr double kHalf = 0.5 * kTargetSide;

/// Homography to target units from the corners in a camera without distortion.
Mat3 TargetFromCorners(const std::array<Vec2, 4>& corners) {
  constexpr Mat3 kTargetFromUnit{{kHalf, 0, kHalf, 0, -kHalf, kHalf, 0, 0, 1}};
  return kTargetFromUnit * Adjugate(HomographyToQuad(corners));
}

std::array<Vec2, 4> CornersOf(const Mat3& target_from_undistorted) {
  std::array<Vec2, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[i] = Apply(Adjugate(target_from_undistorted),
                       {kHalf + kHalf * kSquareCorners[i].x, kHalf - kHalf * kSquareCorners[i].y});
  }
  return corners;
}

/// A picture in view: the observed image and its prediction.
class PictureAlignment : public testing::Test {
 protected:
  PictureAlignment()
      : lens_(camera_), picture_(DeadLeaves(1, 400, 300)), pyramid_(Codes().view()) {}

  GreyImage Codes() const { return picture_.Codes(); }

  HungPicture Hung(double side_px, double tilt_deg) const {
    return HangAt(camera_, picture_, {162, 118}, side_px, tilt_deg, 40, 20);
  }

  /// Takes a window around the picture.
  ObservedPatch See(const GreyImage& frame, int level) const {
    ObservedPatch observed;
    TakeLinearWindow(lens_, frame.view(),
                     {level, 0, 0, frame.width() >> level, frame.height() >> level}, &observed);
    return observed;
  }

  const CameraModel camera_ = SgCamera(320, 240, 400);
  const LensGrid lens_;
  const TestPicture picture_;
  const PicturePyramid pyramid_;
};

TEST_F(PictureAlignment, PredictsWhatAPerfectCameraSees) {
  struct View {
    double side_px, tilt_deg, blur_px;
  };
  for (const View& view : {View{180, 0, 0.7}, {180, 55, 0.7}, {90, 30, 1.2}, {45, 20, 0.6}}) {
    SCOPED_TRACE(testing::Message() << view.side_px << " px, " << view.tilt_deg << " degrees");
    const HungPicture hung = Hung(view.side_px, view.tilt_deg);
    const GreyImage frame = RenderPictures(camera_, {hung}, {.blur_px = view.blur_px});
    const ObservedPatch observed = See(frame, 0);
    PictureRaster raster;
    PlaneMap map;
    PredictedImage predicted;
    std::vector<RowRange> ranges;
    raster.Render(pyramid_, TargetFromCorners(TrueCorners(camera_, hung)), observed.rays,
                  view.blur_px, &map, &predicted, &ranges);
    // The renderer's white is 0.8; the pyramid's is the level that the brightest values exceed.
    double pp = 0.0, pi = 0.0, ii = 0.0;
    for (std::size_t k = 0; k < observed.value.size(); ++k) {
      if (!(map.column[k] > 4 && map.column[k] < 60 && map.row[k] > 4 && map.row[k] < 60)) continue;
      pp += predicted.white[k] * predicted.white[k];
      pi += predicted.white[k] * observed.value[k];
      ii += observed.value[k] * observed.value[k];
    }
    ASSERT_GT(pp, 0.0);
    // Residual after one exposure scale: interpolation adds slight blur.
    EXPECT_LT(1.0 - pi * pi / (pp * ii), 0.006);
  }
}

TEST_F(PictureAlignment, SlopesAreThoseOfThePrediction) {
  const HungPicture hung = Hung(120, 30);
  const ObservedPatch observed = See(RenderPictures(camera_, {hung}, {}), 0);
  PictureRaster raster;
  PlaneMap map;
  PredictedImage at, moved;
  std::vector<RowRange> ranges;
  const Mat3 target_from_undistorted = TargetFromCorners(TrueCorners(camera_, hung));
  constexpr double kBlur_px = 1.5, kStep_px = 0.05;
  raster.Render(pyramid_, target_from_undistorted, observed.rays, kBlur_px, &map, &at, &ranges);
  for (const bool along_x : {true, false}) {
    // Central difference by the camera's position.
    std::vector<double> difference(at.white.size(), 0.0);
    for (const double sign : {1.0, -1.0}) {
      const Mat3 shift{
          {1, 0, along_x ? sign * kStep_px : 0, 0, 1, along_x ? 0 : sign * kStep_px, 0, 0, 1}};
      PlaneMap moved_map;
      raster.Render(pyramid_, target_from_undistorted * shift, observed.rays, kBlur_px, &moved_map,
                    &moved, &ranges);
      for (std::size_t k = 0; k < difference.size(); ++k) {
        difference[k] += sign * moved.white[k] / (2.0 * kStep_px);
      }
    }
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < difference.size(); ++k) {
      if (!(map.column[k] > 4 && map.column[k] < 60 && map.row[k] > 4 && map.row[k] < 60)) continue;
      const double slope = along_x ? at.white_x[k] : at.white_y[k];
      error += (slope - difference[k]) * (slope - difference[k]);
      size += difference[k] * difference[k];
    }
    // Two samples per pixel interpolate between texels; a step along these slopes has that
    // accuracy.
    EXPECT_LT(std::sqrt(error / size), 0.08) << (along_x ? "x" : "y");
  }
}

TEST_F(PictureAlignment, ComesBackFromPixelsAwayToHundredths) {
  for (const double off_px : {0.3, 1.0, 2.5}) {
    for (const double tilt_deg : {10.0, 50.0}) {
      SCOPED_TRACE(testing::Message() << off_px << " px off at " << tilt_deg << " degrees");
      const HungPicture hung = Hung(150, tilt_deg);
      const GreyImage frame =
          RenderPictures(camera_, {hung}, {.blur_px = 0.6, .noise_codes = 1.5, .seed = 3});
      const std::array<Vec2, 4> truth = TrueCorners(camera_, hung);
      std::array<Vec2, 4> guess = truth;
      for (int i = 0; i < 4; ++i) {
        guess[i] = guess[i] + Vec2{off_px * std::cos(2.1 * i), off_px * std::sin(2.1 * i)};
      }
      const ObservedPatch observed = See(frame, 0);
      PictureFitState state{TargetFromCorners(guess)};
      PictureFit fit;
      ASSERT_TRUE(fit.Run(pyramid_, observed, 8,
                          {.steps = 20, .fit_blur = true, .min_weight = 0.01}, &state));
      const std::array<Vec2, 4> corners = CornersOf(state.target_from_undistorted);
      for (int i = 0; i < 4; ++i) EXPECT_LT(Norm(corners[i] - truth[i]), 0.06) << "corner " << i;
      EXPECT_GT(fit.Correlation(), 0.97);
      EXPECT_NEAR(state.blur_px, 0.5, 0.25);
    }
  }
}

TEST_F(PictureAlignment, SaysWhichBlocksAreCovered) {
  HungPicture hung = Hung(160, 20);
  hung.cover = [](Vec2 at) { return at.y < 0.5 ? 0.3 + 0.2 * std::sin(40 * at.x) : -1.0; };
  const ObservedPatch observed =
      See(RenderPictures(camera_, {hung}, {.blur_px = 0.6, .noise_codes = 1.0}), 0);
  PictureFitState state{TargetFromCorners(TrueCorners(camera_, hung))};
  PictureFit fit;
  ASSERT_TRUE(fit.Run(pyramid_, observed, 8, {.steps = 4}, &state));
  fit.Compare(observed);
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      const TargetBlock& block = fit.blocks()[row * 8 + column];
      if (!block.informative || row == 3 || row == 4) continue;
      if (row < 4) {
        EXPECT_LT(block.detail_correlation, 0.6) << row << ", " << column;
      } else {
        EXPECT_GT(block.detail_correlation, 0.8) << row << ", " << column;
        EXPECT_GT(block.gain, 0.5) << row << ", " << column;
      }
    }
  }
}

TEST_F(PictureAlignment, HasNoAnswerWhereNothingIsSeen) {
  GreyImage black(320, 240);
  PictureFit fit;
  PictureFitState state{TargetFromCorners(TrueCorners(camera_, Hung(100, 0)))};
  EXPECT_FALSE(fit.Run(pyramid_, See(black, 0), 6, {}, &state));
  std::fill_n(black.data(), black.size(), std::uint8_t{255});
  EXPECT_FALSE(fit.Run(pyramid_, See(black, 0), 6, {}, &state));
}

TEST(PicturePyramidTest, HalvesInLinearLight) {
  GreyImage picture(37, 20);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    picture.data()[i] = static_cast<std::uint8_t>(i * 53 % 200 + 20);
  }
  const PicturePyramid pyramid(picture.view());
  ASSERT_GE(pyramid.levels(), 3);
  EXPECT_EQ(pyramid.level(1).width(), 18);
  EXPECT_EQ(pyramid.level(2).height(), 5);
  const auto& linear = LinearFromSrgb8();
  const double unit = linear[picture(0, 0)] / pyramid.level(0)(0, 0);
  double sum = 0.0;
  for (int y = 4; y < 8; ++y) {
    for (int x = 8; x < 12; ++x) sum += linear[picture(x, y)] / 16.0;
  }
  EXPECT_NEAR(pyramid.level(2)(2, 1) * unit, sum, 1e-5);
}

}  // namespace
}  // namespace pleinair::tracker
