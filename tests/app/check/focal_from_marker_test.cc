#include "app/check/focal_from_marker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/frames.h"

namespace pleinair::app {
namespace {

CameraModel Lens(double focal_px) {
  CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = focal_px;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

/// Corners of a marker of 0.5 m in the image, tilted about x, turned about z.
std::array<Vec2, 4> Seen(const CameraModel& camera, double tilt_rad, double turn_rad) {
  const double c = std::cos(tilt_rad), s = std::sin(tilt_rad);
  const double ct = std::cos(turn_rad), st = std::sin(turn_rad);
  const Mat3 tilt{{1, 0, 0, 0, c, -s, 0, s, c}}, turn{{ct, -st, 0, st, ct, 0, 0, 0, 1}};
  const Transform<Camera, Marker> pose{tilt * turn, {0.1, -0.05, 2.0}};
  std::array<Vec2, 4> corners;
  const Vec3 square[] = {{-0.25, 0.25, 0}, {0.25, 0.25, 0}, {0.25, -0.25, 0}, {-0.25, -0.25, 0}};
  for (int i = 0; i < 4; ++i) corners[i] = ProjectToPixel(camera, pose * Point<Marker>{square[i]});
  return corners;
}

TEST(FocalRatioFromSquare, IsExactWithoutNoise) {
  for (const double tilt_rad : {0.4, 0.8, -1.0}) {
    for (const double turn_rad : {0.0, 0.3, 2.0}) {
      const auto ratio = FocalRatioFromSquare(Lens(500.0), Seen(Lens(600.0), tilt_rad, turn_rad));
      ASSERT_TRUE(ratio);
      EXPECT_NEAR(ratio->log_ratio, std::log(1.2), 1e-9);
      EXPECT_GT(ratio->error, 0.0);
    }
  }
}

TEST(FocalRatioFromSquare, IsUncertainFromStraightAbove) {
  const CameraModel lens = Lens(600.0);
  const auto tilted = FocalRatioFromSquare(lens, Seen(lens, 0.8, 0.3));
  const auto above = FocalRatioFromSquare(lens, Seen(lens, 0.05, 0.3));
  ASSERT_TRUE(tilted);
  EXPECT_LT(tilted->error, 0.05);
  if (above) {
    EXPECT_GT(above->error, 0.3);
  }
  EXPECT_FALSE(FocalRatioFromSquare(lens, {{{1, 1}, {1, 1}, {1, 1}, {1, 1}}}));
}

TEST(CombineFocalRatios, SeparatesAWanderingLensFromNoise) {
  const std::vector<FocalRatio> same(6, {0.1, 0.02});
  const auto steady = CombineFocalRatios(same);
  ASSERT_TRUE(steady);
  EXPECT_NEAR(steady->ratio, std::exp(0.1), 1e-12);
  EXPECT_NEAR(steady->error, 0.02 / std::sqrt(6.0), 1e-12);
  EXPECT_EQ(steady->wander, 0.0);
  std::vector<FocalRatio> zooming;
  for (const double off : {-0.1, 0.1, -0.1, 0.1, -0.1, 0.1}) zooming.push_back({off, 0.01});
  const auto wandering = CombineFocalRatios(zooming);
  ASSERT_TRUE(wandering);
  EXPECT_NEAR(wandering->wander, 0.1, 0.02);
  EXPECT_GT(wandering->wander_chi2, 50.0);
  EXPECT_FALSE(CombineFocalRatios(std::vector<FocalRatio>(6, {0.0, 0.5})));
}

}  // namespace
}  // namespace pleinair::app
