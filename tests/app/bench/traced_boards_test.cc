// The truth of the benchmark of depth of field against closed forms.
#include "app/bench/traced_boards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace pleinair::app {
namespace {

DefocusScene SceneOf(std::vector<BenchBoard> boards) {
  DefocusScene scene;
  scene.boards = std::move(boards);
  return scene;
}

/// Share of a disc of diameter 1 on one side of a line at the distance u from its centre, −½…½:
/// circular segment.
double DiscSide(double u) {
  const double s = std::clamp(2.0 * u, -1.0, 1.0);
  return 0.5 + (s * std::sqrt(1.0 - s * s) + std::asin(s)) / std::numbers::pi;
}

TEST(TracedBoards, HaveTheEdgeOfADisc) {
  for (const double circle_px : {-8.0, 3.0}) {
    const Image<float> light =
        TraceBoards(SceneOf({{20.0, -100.0, 200.0, 100.0, circle_px, 0.8F}}), 40, 3);
    for (int x = 0; x < 40; ++x) {
      double expected = 0.0;
      constexpr int kParts = 64;  // Across the pixel's width.
      for (int i = 0; i < kParts; ++i) {
        expected += DiscSide((x + (i + 0.5) / kParts - 20.0) / std::fabs(circle_px));
      }
      EXPECT_NEAR(light(x, 1), 0.8 * expected / kParts, 0.003) << x << ", " << circle_px;
    }
  }
}

TEST(TracedBoards, ThatShareTheirEdgeAndFocusHideOneAnother) {
  // Two boards at one distance: nothing of the farther one shows beside the nearer one.
  const BenchBoard nearer{10.0, 5.0, 30.0, 25.0, 6.0, 0.2F};
  BenchBoard farther = nearer;
  farther.light = 0.9F;
  const Image<float> both = TraceBoards(SceneOf({nearer, farther}), 40, 30);
  const Image<float> alone = TraceBoards(SceneOf({nearer}), 40, 30);
  for (std::size_t i = 0; i < both.size(); ++i) EXPECT_EQ(both.data()[i], alone.data()[i]);
  EXPECT_NEAR(both(20, 15), 0.2, 1e-6);
}

TEST(TracedBoards, ShowWhatLiesBehindABlurredRim) {
  // A rim before the focus covers half of the stop where its edge lies: half of the light behind.
  const Image<float> light = TraceBoards(
      SceneOf({{-100.0, -100.0, 20.5, 100.0, -10.0, 0.0F}, {0.0, -100.0, 100.0, 100.0, 0.0, 1.0F}}),
      40, 3);
  EXPECT_NEAR(light(20, 1), 0.5, 0.005);
  EXPECT_NEAR(light(10, 1), 0.0, 1e-6);
  EXPECT_NEAR(light(30, 1), 1.0, 1e-6);
}

TEST(TracedBoards, HaveTheEdgeOfABoxBeforeAMovingCamera) {
  // A board at 2 m, before a camera that moves by 10 px of its distance.
  constexpr double kMoved_px = 10.0, kDistance_m = 2.0;
  const CameraModel camera{.width = 40, .height = 3, .fx = 50, .fy = 50, .cx = 19.5, .cy = 1};
  DefocusScene scene = SceneOf({{20.0, -100.0, 200.0, 100.0, 0.0, 0.8F, kDistance_m}});
  scene.camera_from_marker = {Mat3{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0, 0, 0}};
  scene.motion = [&](double share) {
    Transform<Camera, Marker> pose = scene.camera_from_marker;
    pose.translation_m.x += share * kMoved_px * kDistance_m / camera.fx;
    return pose;
  };
  const Image<float> light = TraceMovingCamera(scene, camera);
  for (int x = 0; x < camera.width; ++x) {
    double expected = 0.0;
    constexpr int kParts = 64;  // Across the pixel's width.
    for (int i = 0; i < kParts; ++i) {
      expected += std::clamp((x + (i + 0.5) / kParts - 20.0) / kMoved_px + 0.5, 0.0, 1.0) / kParts;
    }
    EXPECT_NEAR(light(x, 1), 0.8 * expected, 0.003) << x;
  }
}

}  // namespace
}  // namespace pleinair::app
