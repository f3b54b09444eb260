#include "compositor/passes/render_camera.h"

#include <gtest/gtest.h>

#include "base/pixel_origin.h"
#include "compositor/passes/scene_view.h"

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
  // The lens maps that ray back to its pixel.
  const Vec2 back = ProjectToPixel(kDistorted, Point<Camera>{{ray.x, ray.y, 1.0}});
  EXPECT_NEAR(back.x, 150, 1e-6);
  EXPECT_NEAR(back.y, 10, 1e-6);
}

TEST(RenderCamera, HasTheSameRaysOnACoarserGrid) {
  const RenderCamera fine{.width = 161, .height = 120, .fx = 150, .fy = 151, .cx = 70.5, .cy = 60};
  const RenderCamera coarse = CoarserBy(4, fine);
  EXPECT_EQ(coarse.width, 41);
  EXPECT_EQ(coarse.height, 30);
  // The centre of a coarse pixel is the corner between the middle four of its sixteen pixels.
  for (const int pixel : {0, 7, 29}) {
    EXPECT_NEAR((pixel - coarse.cx) / coarse.fx, (4 * pixel + 1.5 - fine.cx) / fine.fx, 1e-12);
    EXPECT_NEAR((pixel - coarse.cy) / coarse.fy, (4 * pixel + 1.5 - fine.cy) / fine.fy, 1e-12);
  }
}

// Two metres in front of the marker's centre, turned about two axes.
const CameraModel kPinhole{
    .width = 160, .height = 120, .fx = 150, .fy = 151, .cx = 70.5, .cy = 60.25};
const Transform<Camera, Marker> kTilted{{{0.8, 0.6, 0, 0.48, -0.64, -0.6, -0.36, 0.48, -0.8}},
                                        {0.1, -0.05, 2}};

TEST(SceneView, SeesAPointOfTheSceneAlongTheRayOfItsPixel) {
  const RenderCamera render = FitRenderCamera(kPinhole, 1.0);
  const shadows::Box bounds{{-1, -1, 0}, {1, 1, 0.5}};
  const auto ray = RaysThroughPixels(render, ViewOf(render, kTilted, bounds));
  const Point<Marker> point{{0.2, 0.1, 0.3}};
  const Vec2 pixel = CornerOriginFromPixel(ProjectToPixel(kPinhole, kTilted * point));
  const glm::vec3 along =
      ray[0] + static_cast<float>(pixel.x) * ray[1] + static_cast<float>(pixel.y) * ray[2];
  const Vec3 eye = kTilted.Inverse().translation_m;
  const double depth = (kTilted * point).xyz.z;
  EXPECT_NEAR(eye.x + depth * along.x, point.xyz.x, 1e-6);
  EXPECT_NEAR(eye.y + depth * along.y, point.xyz.y, 1e-6);
  EXPECT_NEAR(eye.z + depth * along.z, point.xyz.z, 1e-6);
}

TEST(SceneView, ProjectsTrianglesForTilesToTheirPixels) {
  const RenderCamera render = FitRenderCamera(kPinhole, 1.0);
  const shadows::View view = ViewOf(render, kTilted, {{-1, -1, 0}, {1, 1, 0.5}});
  const SceneProjection image = ProjectionOf(render, view, 3);
  EXPECT_EQ(image.width, 160);
  EXPECT_EQ(image.height, 120);
  EXPECT_EQ(image.spread_px, 3);
  const Vec2 pixel =
      CornerOriginFromPixel(ProjectToPixel(kPinhole, kTilted * Point<Marker>{{0.1, 0.2, 0.3}}));
  const glm::vec4 clip = image.clip_from_position * glm::vec4(0.1F, 0.2F, 0.3F, 1.0F);
  EXPECT_NEAR((0.5F * clip.x / clip.w + 0.5F) * 160, pixel.x, 1e-3);
  EXPECT_NEAR((0.5F * clip.y / clip.w + 0.5F) * 120, pixel.y, 1e-3);
  EXPECT_NEAR(clip.w, (kTilted * Point<Marker>{{0.1, 0.2, 0.3}}).xyz.z, 1e-5);
  EXPECT_FLOAT_EQ(image.near_m, static_cast<float>(view.near_m));
}

}  // namespace
}  // namespace pleinair::compositor
