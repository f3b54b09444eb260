#include "compositor/render_camera.h"

#include <gtest/gtest.h>

#include "base/pixel_origin.h"

namespace pleinair::compositor {
namespace {

const CameraModel kDistorted{.width = 160,
                             .height = 120,
                             .fx = 146,
                             .fy = 147,
                             .cx = 81.5,
                             .cy = 58.9,
                             .distortion = {-0.13, 0.045, 0.0006, -0.0004, 0, 0, 0, 0}};

TEST(RenderCamera, EqualsAPinholeCameraAtItsOwnResolution) {
  const CameraModel camera{
      .width = 160, .height = 120, .fx = 150, .fy = 151, .cx = 79.5, .cy = 60.25};
  const RenderCamera render = FitRenderCamera(camera, 1.0);
  EXPECT_EQ(render.width, 160);
  EXPECT_EQ(render.height, 120);
  const Image<float> positions = RenderPositions(camera, render);
  for (const int x : {0, 80, 159}) {
    EXPECT_NEAR(positions(x, 7, 0), x + 0.5, 1e-4);
    EXPECT_NEAR(positions(x, 7, 1), 7.5, 1e-4);
  }
}

TEST(RenderCamera, CoversEverythingThatADistortedLensSees) {
  for (const double supersampling : {1.0, 1.5, 2.0}) {
    const RenderCamera render = FitRenderCamera(kDistorted, supersampling);
    const Image<float> positions = RenderPositions(kDistorted, render);
    for (int y = 0; y < kDistorted.height; ++y) {
      for (int x = 0; x < kDistorted.width; ++x) {
        ASSERT_GE(positions(x, y, 0), 0.5F);
        ASSERT_LE(positions(x, y, 0), render.width - 0.5F);
        ASSERT_GE(positions(x, y, 1), 0.5F);
        ASSERT_LE(positions(x, y, 1), render.height - 0.5F);
      }
    }
  }
}

TEST(RenderCamera, PutsAPointWhereTheRealLensSeesIt) {
  const RenderCamera render = FitRenderCamera(kDistorted, 1.5);
  const Image<float> positions = RenderPositions(kDistorted, render);
  const Vec2 ray = UndistortPixel(kDistorted, {150, 10});
  const Vec2 drawn =
      CornerOriginFromPixel({render.fx * ray.x + render.cx, render.fy * ray.y + render.cy});
  EXPECT_NEAR(positions(150, 10, 0), drawn.x, 1e-3);
  EXPECT_NEAR(positions(150, 10, 1), drawn.y, 1e-3);
  // And the lens takes that ray back to its pixel.
  const Vec2 back = ProjectToPixel(kDistorted, Point<Camera>{{ray.x, ray.y, 1.0}});
  EXPECT_NEAR(back.x, 150, 1e-6);
  EXPECT_NEAR(back.y, 10, 1e-6);
}

}  // namespace
}  // namespace pleinair::compositor
