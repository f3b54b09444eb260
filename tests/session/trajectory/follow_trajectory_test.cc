#include "session/trajectory/follow_trajectory.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/error_message.h"
#include "tests/session/trajectory/made_trajectory.h"

namespace pleinair::session {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using tests::MessageOf;

constexpr double kMaxTurn_rad = 0.005;

scene::MarkerDescription LyingMarker() {
  scene::MarkerDescription marker;
  marker.size_m = MadeTrajectory::kMarkerSize_m;
  return marker;
}

Result<FollowedTrajectory> Follow(const MadeTrajectory& made, const std::vector<Observation>& track,
                                  const TrajectoryRequest& request) {
  return FollowTrajectory(made.camera(), LyingMarker(), made.times(), track, track, request);
}

std::vector<int> EveryFrame(int first, int step) {
  std::vector<int> frames;
  for (int i = first; i < MadeTrajectory::kFrames; i += step) frames.push_back(i);
  return frames;
}

void ExpectTruePoses(const Result<FollowedTrajectory>& followed) {
  ASSERT_TRUE(followed) << followed.error().Message();
  EXPECT_EQ(followed->observations.size(), static_cast<std::size_t>(MadeTrajectory::kFrames));
  const MadeTrajectory::Distance farthest = MadeTrajectory::FarthestOf(followed->observations);
  EXPECT_LT(farthest.centre_m, 0.002);
  EXPECT_LT(farthest.turn_rad, kMaxTurn_rad);
  testing::Test::RecordProperty("centre_mm", std::to_string(1e3 * farthest.centre_m));
}

TEST(FollowTrajectory, OneViewOfTheMarkerPlacesAllFrames) {
  MadeTrajectory made;
  const auto followed = Follow(made, made.Seen({70}), {made.Given(1.0), 0});
  ExpectTruePoses(followed);
  const TrajectorySummary& summary = followed->summary;
  EXPECT_EQ(summary.frames.by_trajectory, MadeTrajectory::kFrames);
  EXPECT_EQ(summary.frames.without_marker, MadeTrajectory::kFrames - 1);
  EXPECT_EQ(summary.alignment.used, 1U);
  EXPECT_GT(summary.centre_deviation_m, 0.0);
  EXPECT_LT(summary.centre_deviation_m, 0.01);
}

TEST(FollowTrajectory, TwoViewsGiveTheScale) {
  MadeTrajectory made;
  constexpr double kUnit_m = 0.37;
  const auto followed = Follow(made, made.Seen({5, 110}, 0.01), {made.Given(kUnit_m), 0});
  ASSERT_TRUE(followed) << followed.error().Message();
  EXPECT_NEAR(followed->summary.alignment.marker_from_trajectory.scale, kUnit_m, 0.002);
  ExpectTruePoses(followed);
}

TEST(FollowTrajectory, OneViewDoesNotGiveTheScale) {
  MadeTrajectory made;
  const auto one = Follow(made, made.Seen({70}), {made.Given(0.37), 0});
  EXPECT_THAT(MessageOf(one), HasSubstr("walk.tum: has no scale"));
  // Two views from one place.
  std::vector<Observation> twice = made.Seen({70, 70});
  twice[1].frame_index = 71;
  GivenTrajectory still = made.Given(0.37);
  still.by_frame = true;
  still.poses.resize(2);
  for (GivenPose& pose : still.poses) pose = made.Given(0.37).poses[130];
  still.poses[0].frame_index = 70;
  still.poses[1].frame_index = 71;
  EXPECT_THAT(MessageOf(Follow(made, twice, {still, 0})),
              HasSubstr("two views from places that are apart"));
}

TEST(FollowTrajectory, ThreePlacesNeedNoMarker) {
  MadeTrajectory made;
  for (const double unit_m : {1.0, 0.37}) {
    const auto places = made.Places({{0, 0, 0}, {1.2, 0.1, 0}, {0.2, 0.9, 0.4}}, unit_m);
    const auto followed = Follow(made, {}, {made.Given(unit_m), 0, {}, places});
    ExpectTruePoses(followed);
    EXPECT_FALSE(followed->summary.marker_rms_px);
    EXPECT_LT(followed->summary.alignment.residual_max, 1e-9);
  }
}

TEST(FollowTrajectory, PlacesOnALineAreRefused) {
  MadeTrajectory made;
  const auto places = made.Places({{0, 0, 0}, {1, 0, 0}, {2, 0.001, 0}, {3, 0, 0}}, 1.0);
  EXPECT_THAT(MessageOf(Follow(made, {}, {made.Given(1.0), 0, {}, places})),
              HasSubstr("lie on a line or at one point"));
  EXPECT_THAT(MessageOf(Follow(made, {}, {made.Given(1.0), 0, {}, {places[0], places[1]}})),
              HasSubstr("fewer than three places"));
}

TEST(FollowTrajectory, FindsTheOffsetOfAnotherClock) {
  MadeTrajectory made;
  constexpr std::int64_t kClock_ns = 1'305'031'098'665'900'000;
  const auto followed =
      Follow(made, made.Seen(EveryFrame(0, 5)), {made.Given(1.0, kClock_ns), std::nullopt});
  ExpectTruePoses(followed);
  const TrajectoryOffset& offset = followed->summary.offset;
  ASSERT_TRUE(offset.deviation_s);
  // The trajectory begins 20 poses before the film.
  EXPECT_NEAR(static_cast<double>(offset.offset_ns + kClock_ns) * 1e-9, 0.0, 0.002);
}

TEST(FollowTrajectory, FindsTheOffsetByMoreViewsOfASample) {
  MadeTrajectory made;
  constexpr std::int64_t kLate_ns = 150'000'000;
  TrajectoryRequest request{made.Given(1.0, kLate_ns), std::nullopt};
  const std::vector<Observation> sample = made.Seen({60, 75});
  EXPECT_FALSE(Follow(made, sample, request)->summary.offset.deviation_s);
  std::vector<int> nearby;
  for (int i = 54; i < 80; i += 2) nearby.push_back(i);
  request.more_views = made.Seen(nearby);
  const auto followed = Follow(made, sample, request);
  ExpectTruePoses(followed);
  const TrajectoryOffset& offset = followed->summary.offset;
  ASSERT_TRUE(offset.deviation_s);
  EXPECT_NEAR(static_cast<double>(offset.offset_ns + kLate_ns) * 1e-9, 0.0, 0.003);
  // Frame 60 is in both; they get no pose of their own.
  EXPECT_EQ(followed->summary.alignment.used, 14U);
  EXPECT_EQ(followed->summary.frames.without_marker, MadeTrajectory::kFrames - 2);
}

TEST(FollowTrajectory, TakesTheClockOfTheCamera) {
  MadeTrajectory made;
  constexpr std::int64_t kClock_ns = 1'403'636'579'763'555'584;
  // Within the first pose: so it does not begin with the recording.
  const auto followed =
      Follow(made, made.Seen({70}), {made.Given(1.0, kClock_ns), std::nullopt, kClock_ns});
  ExpectTruePoses(followed);
  EXPECT_EQ(followed->summary.offset.offset_ns, -kClock_ns);
}

TEST(FollowTrajectory, SaysThatOneViewGivesNoOffset) {
  MadeTrajectory made;
  const auto followed = Follow(made, made.Seen({70}), {made.Given(1.0), std::nullopt});
  ASSERT_TRUE(followed);
  EXPECT_EQ(followed->summary.offset.offset_ns, 0);
  EXPECT_FALSE(followed->summary.offset.deviation_s);
}

TEST(FollowTrajectory, AViewThatContradictsTheOthersDoesNotCount) {
  MadeTrajectory made;
  std::vector<Observation> track = made.Seen(EveryFrame(2, 9));
  for (Vec2& corner : track[4].corners_px) corner = corner + Vec2{60.0, -35.0};
  const auto followed = Follow(made, track, {made.Given(1.0), 0});
  ExpectTruePoses(followed);
  EXPECT_EQ(followed->summary.alignment.outliers, 1U);
}

TEST(FollowTrajectory, ATrajectoryThatContradictsTheMarkerIsReportedOrRefused) {
  MadeTrajectory made;
  GivenTrajectory turned = made.Given(1.0);
  // The inverse rotations, as of a file with camera-from-world poses.
  for (GivenPose& pose : turned.poses) {
    pose.world_from_camera.rotation = pose.world_from_camera.rotation.Transposed();
  }
  const std::vector<Observation> track = made.Seen(EveryFrame(0, 7));
  const auto followed = Follow(made, track, {turned, 0});
  ASSERT_TRUE(followed) << followed.error().Message();
  EXPECT_GT(followed->summary.alignment.chi2_per_dof, 100.0);
  // Three times as far as it was.
  for (GivenPose& pose : turned.poses) {
    pose.world_from_camera.translation_m = pose.world_from_camera.translation_m * 3.0;
  }
  EXPECT_THAT(
      MessageOf(Follow(made, track, {turned, 0})),
      AnyOf(HasSubstr("contradicts the marker"), HasSubstr("does not fit the frames that show")));
}

TEST(FollowTrajectory, ShortGapsAreFilledAndLongOnesStay) {
  MadeTrajectory made;
  GivenTrajectory given = made.Given(1.0);
  std::erase_if(given.poses, [](const GivenPose& pose) {
    const double t_s = static_cast<double>(pose.timestamp_ns) * 1e-9;
    return (t_s > 1.0 && t_s < 1.3) || t_s > 3.0;
  });
  // The marker is seen at the start, and once after the trajectory's end.
  const auto followed = Follow(made, made.Seen({0, 10, 110}), {given, 0});
  ASSERT_TRUE(followed) << followed.error().Message();
  const TrajectoryFrames& frames = followed->summary.frames;
  EXPECT_NEAR(static_cast<double>(frames.filled), 9.0, 2.0);
  EXPECT_EQ(frames.by_marker, 1);
  EXPECT_GT(frames.missing, 20);
  EXPECT_EQ(frames.by_trajectory + frames.by_marker + frames.filled + frames.missing,
            MadeTrajectory::kFrames);
  EXPECT_LT(MadeTrajectory::FarthestOf(followed->observations).centre_m, 0.004);
}

TEST(FollowTrajectory, MatchesByFrameWhereNumbersAreKnown) {
  MadeTrajectory made;
  GivenTrajectory given = made.Given(1.0);
  given.by_frame = true;
  given.poses.clear();
  for (int i = 0; i < MadeTrajectory::kFrames; i += 2) {
    GivenPose pose;
    pose.frame_index = i;
    pose.world_from_camera.rotation =
        MadeTrajectory::TruePose(i / MadeTrajectory::kFrameRate_hz).Inverse().rotation;
    pose.world_from_camera.translation_m =
        MadeTrajectory::TruePose(i / MadeTrajectory::kFrameRate_hz).Inverse().translation_m;
    given.poses.push_back(pose);
  }
  const auto followed = Follow(made, made.Seen({20}), {given, std::nullopt});
  ASSERT_TRUE(followed) << followed.error().Message();
  EXPECT_EQ(followed->summary.frames.by_trajectory, MadeTrajectory::kFrames / 2);
  EXPECT_LT(MadeTrajectory::FarthestOf(followed->observations).centre_m, 0.002);
}

TEST(FollowTrajectory, TheStatedDeviationHoldsInMostTrials) {
  // One view each time: the marker's centre is off by its noise alone.
  MadeTrajectory made;
  int within = 0;
  constexpr int kTrials = 40;
  for (int i = 0; i < kTrials; ++i) {
    const auto followed = Follow(made, made.Seen({60}, 0.1), {made.Given(1.0), 0});
    ASSERT_TRUE(followed);
    const Observation& at = followed->observations[60];
    const double off_m =
        Norm(at.camera_from_marker.translation_m -
             MadeTrajectory::TruePose(60 / MadeTrajectory::kFrameRate_hz).translation_m);
    within += off_m < 2.0 * at.centre_deviation_m ? 1 : 0;
  }
  EXPECT_GE(within, 34);
}

}  // namespace
}  // namespace pleinair::session
