#include "base/scaled_camera.h"

#include <gtest/gtest.h>

namespace pleinair {
namespace {

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

}  // namespace
}  // namespace pleinair
