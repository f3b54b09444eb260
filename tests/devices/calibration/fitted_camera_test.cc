#include "devices/calibration/fitted_camera.h"

#include <gmock/gmock.h>

namespace pleinair::devices {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

CameraModel Lens() {
  CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 600.0;
  camera.fy = 610.0;
  camera.cx = 325.0;
  camera.cy = 230.0;
  camera.distortion = {-0.1, 0.03, 0.002, -0.004, 0.01};
  return camera;
}

TEST(FittedCamera, TurnsAsTheImageDoes) {
  const Vec3 point{0.3, -0.2, 1.0};
  const Vec2 before = ProjectToPixel(Lens(), Point<Camera>{point});
  // Clockwise by a quarter: right becomes down, down becomes left.
  const Vec2 quarter =
      ProjectToPixel(TurnCamera(Lens(), 1), Point<Camera>{{-point.y, point.x, point.z}});
  EXPECT_NEAR(quarter.x, 479.0 - before.y, 1e-9);
  EXPECT_NEAR(quarter.y, before.x, 1e-9);
  const Vec2 three =
      ProjectToPixel(TurnCamera(Lens(), 3), Point<Camera>{{point.y, -point.x, point.z}});
  EXPECT_NEAR(three.x, before.y, 1e-9);
  EXPECT_NEAR(three.y, 639.0 - before.x, 1e-9);
}

TEST(FittedCamera, ScalesEqualShapesAndSaysSo) {
  const auto same = FitCamera(Lens(), {640, 480}, 90, "walk.mov");
  ASSERT_TRUE(same);
  EXPECT_THAT(same->note, IsEmpty());
  const auto half = FitCamera(Lens(), {320, 240}, 0, "walk.mov");
  ASSERT_TRUE(half);
  EXPECT_EQ(half->camera.fx, 300.0);
  EXPECT_EQ(half->camera.cx, 162.25);
  EXPECT_THAT(half->note, HasSubstr("640x480 pixels was scaled to 320x240"));
  const auto upright = FitCamera(Lens(), {240, 320}, 270, "walk.mov");
  ASSERT_TRUE(upright);
  EXPECT_EQ(upright->camera.fx, 305.0);
  EXPECT_EQ(upright->camera.width, 240);
  EXPECT_THAT(upright->note, HasSubstr("turned by 270 degrees"));
}

TEST(FittedCamera, RefusesWhatItCannotKnow) {
  const auto crop = FitCamera(Lens(), {640, 360}, 0, "walk.mov");
  ASSERT_FALSE(crop);
  EXPECT_THAT(crop.error().Message(), HasSubstr("another shape"));
  // Held upright to the left or to the right?
  EXPECT_FALSE(FitCamera(Lens(), {480, 640}, 0, "walk.mov"));
  EXPECT_FALSE(FitCamera(Lens(), {480, 640}, 180, "walk.mov"));
}

}  // namespace
}  // namespace pleinair::devices
