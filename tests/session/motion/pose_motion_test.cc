// The camera's motion about the pose of a frame.
#include "session/motion/pose_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace pleinair::session {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;

Transform<Camera, Marker> Swung(double seconds) {
  const double turn = 0.3 * std::sin(4.0 * seconds);
  return {Mat3{{std::cos(turn), 0, std::sin(turn), 0, 1, 0, -std::sin(turn), 0, std::cos(turn)}},
          {0.2 * std::sin(3.0 * seconds), 0.05 * seconds, 1.5}};
}

std::vector<Observation> Path(int frames) {
  std::vector<Observation> path(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    Observation& at = path[static_cast<std::size_t>(i)];
    at.frame_index = i;
    at.timestamp_ns = std::llround(1e9 * i * kFrame_s);
    at.camera_from_marker = Swung(i * kFrame_s);
  }
  return path;
}

double Apart(const Transform<Camera, Marker>& a, const Transform<Camera, Marker>& b) {
  return Norm(a.translation_m - b.translation_m) + RotationAngle(a.rotation, b.rotation);
}

TEST(PoseMotion, IsThatOfThePathAroundTheFrame) {
  const std::vector<Observation> path = Path(30);
  for (const std::size_t i : {std::size_t{0}, std::size_t{12}, std::size_t{29}}) {
    const PoseMotion motion = MotionAbout(path, i);
    ASSERT_TRUE(motion);
    const double at_s = static_cast<double>(i) * kFrame_s;
    EXPECT_EQ(Apart(motion(0.0), path[i].camera_from_marker), 0.0);
    // Within half of the time between two frames. At rest it would be off by 0.03.
    for (const double seconds : {-0.5 * kFrame_s, 0.25 * kFrame_s, 0.5 * kFrame_s}) {
      EXPECT_LT(Apart(motion(seconds), Swung(at_s + seconds)), i == 12 ? 3e-4 : 2e-3)
          << i << ", " << seconds;
    }
  }
}

TEST(PoseMotion, IsUnknownWhereNoPoseIsNear) {
  std::vector<Observation> path = Path(3);
  EXPECT_FALSE(MotionAbout({path.front()}, 0));
  path[1].timestamp_ns += 1'000'000'000;
  path[2].timestamp_ns += 2'000'000'000;
  EXPECT_FALSE(MotionAbout(path, 1));
  EXPECT_FALSE(MovedTo({}, path[0].camera_from_marker));
}

TEST(PoseMotion, LeavesOutMistakenTilts) {
  std::vector<Observation> path = Path(3);
  path[1].camera_from_marker.rotation =
      path[1].camera_from_marker.rotation * Mat3{{1, 0, 0, 0, 0.5, -0.866, 0, 0.866, 0.5}};
  EXPECT_FALSE(MotionAbout(path, 1));
}

TEST(PoseMotion, MovesAnotherPoseAlike) {
  const std::vector<Observation> path = Path(20);
  const PoseMotion motion = MotionAbout(path, 10);
  const Transform<Camera, Marker> other{Mat3{}, {0.1, 0.2, 2.0}};
  const PoseMotion moved = MovedTo(motion, other);
  EXPECT_LT(Apart(moved(0.0), other), 1e-12);
  const auto expected = motion(0.01) * motion(0.0).Inverse() * other;
  EXPECT_LT(Apart(moved(0.01), expected), 1e-12);
}

}  // namespace
}  // namespace pleinair::session
