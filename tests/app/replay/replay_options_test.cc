#include <gtest/gtest.h>

#include "app/replay/replay.h"
#include "app/terminal/progress_bar.h"

namespace pleinair::app {
namespace {

TEST(ImageSize, IsTwoNumbersWithACross) {
  const auto size = ParsePictureSize("--size", "1280x720");
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 1280);
  EXPECT_EQ(size->height, 720);
}

TEST(ImageSize, RefusesAnythingElse) {
  for (const char* text : {"", "x", "1280", "1280x", "x720", "1280x720x3", "-64x64", "0x0", "15x15",
                           "99999999999x20", "1280 x 720", "20000x16"}) {
    EXPECT_FALSE(ParsePictureSize("--size", text)) << text;
  }
}

TEST(ScaleCamera, MovesProjectedPointsAsResizingMovesPixels) {
  CameraModel camera{640, 480, 605, 600, 310, 245, DistortionModel::kBrownConrady, {-0.2, 0.05}};
  const CameraModel scaled = ScaleCamera(camera, {1280, 240});
  const Point<Camera> point{{0.3, -0.2, 2.0}};
  const Vec2 before = ProjectToPixel(camera, point);
  const Vec2 after = ProjectToPixel(scaled, point);
  EXPECT_NEAR(after.x, (before.x + 0.5) * 2.0 - 0.5, 1e-9);
  EXPECT_NEAR(after.y, (before.y + 0.5) * 0.5 - 0.5, 1e-9);
}

TEST(ScaleCamera, KeepsTheCameraAtItsOwnSize) {
  const CameraModel camera{640, 480, 605, 605, 319.5, 239.5, DistortionModel::kBrownConrady, {}};
  const CameraModel same = ScaleCamera(camera, {640, 480});
  EXPECT_DOUBLE_EQ(same.cx, 319.5);
  EXPECT_DOUBLE_EQ(same.fx, 605);
}

TEST(ProgressBar, ShowsShareAndTimeToGo) {
  EXPECT_EQ(ProgressBar::Line("Composing", 30, 90, 10.0),
            "Composing [##########....................] 33 % of 90 frames, 20 s to go");
  EXPECT_EQ(ProgressBar::Line("Composing", 7, std::nullopt, 1.0), "Composing 7 frames");
}

}  // namespace
}  // namespace pleinair::app
