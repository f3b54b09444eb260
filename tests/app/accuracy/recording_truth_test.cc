#include "app/accuracy/recording_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "accuracy/marker_pose.h"
#include "accuracy/random.h"
#include "accuracy/scoring.h"

namespace pleinair::app {
namespace {

TEST(RecordingTruth, LiesBetweenItsNeighboursAndNowhereElse) {
  const Mat3 turn = accuracy::RotationAbout({0, 0, 1}, 0.1);
  const std::vector<exports::TrajectoryPose> poses{{100, {Mat3{}, {0, 0, 1}}, ""},
                                                   {200, {turn, {1, 0, 1}}, ""}};
  const auto between = PoseAt(poses, 150, 100);
  ASSERT_TRUE(between.has_value());
  EXPECT_NEAR(between->translation_m.x, 0.5, 1e-12);
  EXPECT_NEAR(accuracy::AngleBetween(between->rotation, Mat3{}), 0.05, 1e-12);
  EXPECT_NEAR(PoseAt(poses, 200, 100)->translation_m.x, 1.0, 1e-12);
  // Beyond the ends the tolerance is a quarter of a period.
  EXPECT_TRUE(PoseAt(poses, 225, 100).has_value());
  EXPECT_FALSE(PoseAt(poses, 226, 100).has_value());
  // The same holds in a gap.
  EXPECT_FALSE(PoseAt(poses, 150, 40).has_value());
}

TEST(RecordingTruth, IsAlignedThoughAThirdOfThePosesFlipped) {
  const Transform<Marker, exports::Reference> marker_from_reference{
      accuracy::RotationAbout({0.6, 0.8, 0}, 2.5), {10, -20, 5}};
  accuracy::RandomStream random(3, "align");
  std::vector<PosePair> pairs;
  for (int i = 0; i < 60; ++i) {
    const double angle = 0.1 * i;
    const Transform<Marker, Camera> camera{accuracy::RotationAbout({0, 0, 1}, angle),
                                           {2 * std::cos(angle), 2 * std::sin(angle), 1.5}};
    Transform<Marker, Camera> found = camera;
    const bool flipped = i % 3 == 0;
    found.rotation =
        accuracy::RotationAbout({1, 0, 0}, flipped ? 0.5 : 1e-4 * random.Normal()) * found.rotation;
    pairs.push_back({found, marker_from_reference.Inverse() * camera});
  }
  const auto aligned = AlignReference(pairs);
  ASSERT_TRUE(aligned.has_value());
  EXPECT_LT(accuracy::AngleBetween(aligned->rotation, marker_from_reference.rotation), 1e-4);
  // At 23 m from the marker, 1e-4 rad equals 2 mm.
  EXPECT_LT(Norm(aligned->translation_m - marker_from_reference.translation_m), 2e-3);
  EXPECT_FALSE(AlignReference({}).has_value());
}

}  // namespace
}  // namespace pleinair::app
