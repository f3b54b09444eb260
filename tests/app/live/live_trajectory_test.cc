#include "app/live/live_trajectory.h"

#include <gmock/gmock.h>

#include <csignal>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/live/paced_recording.h"
#include "app/terminal/interrupt.h"
#include "tests/small_camera.h"

namespace pleinair::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int64_t kPeriod_ns = 40'000'000;

/// Grey frames that show no marker.
class BlankFrames : public devices::FrameSource {
 public:
  explicit BlankFrames(std::optional<std::int64_t> count) : count_(count) {}

  Result<std::optional<devices::Frame>> Next() override {
    if (count_ && next_ >= *count_) return std::nullopt;
    devices::Frame frame;
    frame.index = next_;
    frame.timestamp_ns = next_++ * kPeriod_ns;
    frame.rgb = RgbImage(tests::kSmallWidth, tests::kSmallHeight, 3);
    frame.grey = GreyImage(tests::kSmallWidth, tests::kSmallHeight, 1);
    return frame;
  }
  std::optional<std::int64_t> FrameCount() const override { return count_; }

 private:
  std::optional<std::int64_t> count_;  // Nothing: they never end.
  std::int64_t next_ = 0;
};

LiveTrajectory::Opener OpenBlank(std::optional<std::int64_t> count) {
  return [count]() -> Result<devices::Recording> {
    devices::Recording recording;
    recording.frames = std::make_unique<BlankFrames>(count);
    recording.camera = tests::SmallCameraOptions().camera;
    return recording;
  };
}

/// A walk along x, a metre a frame, that three places align.
session::TrajectoryRequest Walk() {
  session::TrajectoryRequest request;
  request.trajectory.file = "walk.tum";
  request.trajectory.is_metric = true;
  for (std::int64_t i = 0; i < 3; ++i) {
    session::GivenPose& pose = request.trajectory.poses.emplace_back();
    pose.timestamp_ns = i * kPeriod_ns;
    pose.world_from_camera.translation_m = {static_cast<double>(i), 0.0, -2.0};
  }
  request.offset_ns = 0;
  for (const Vec3 at : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
    request.points.push_back({{at}, {at}});
  }
  return request;
}

/// Where the camera is by the trajectory, along x; nothing without a pose.
std::optional<double> PlaceAt(LiveTrajectory& trajectory, std::int64_t index,
                              std::int64_t timestamp_ns) {
  devices::Frame frame;
  frame.index = index;
  frame.timestamp_ns = timestamp_ns;
  const auto pose = trajectory.PoseIn(frame, std::nullopt);
  if (!pose) return std::nullopt;
  return pose->observation.camera_from_marker.Inverse().translation_m.x;
}

TEST(LiveTrajectory, FollowsAPacedRecordingThroughItsLoops) {
  const InterruptGuard no_signal_yet;
  scene::SceneDescription scene = tests::SmallCameraOptions().scene;
  scene.marker.id = 0;
  LiveTrajectory trajectory(Walk(), scene, OpenBlank(3));
  trajectory.Wait();
  EXPECT_THAT(trajectory.TakeNews().value_or(""),
              HasSubstr("pose of 3 of 3 frames; offset of its clock 0.000 s, given"));
  EXPECT_EQ(trajectory.TakeNews(), std::nullopt);
  PacedRecording::Options pace{1000.0, true};
  pace.played = [&](std::int64_t index, const devices::Frame& recorded) {
    trajectory.Played(index, {recorded.index, recorded.timestamp_ns});
  };
  auto paced = PacedRecording::Open(
      []() -> Result<std::unique_ptr<devices::FrameSource>> {
        return std::make_unique<BlankFrames>(3);
      },
      pace);
  ASSERT_TRUE(paced);
  std::vector<std::int64_t> indices;
  std::vector<double> places;
  for (int i = 0; i < 7; ++i) {
    const auto frame = (*paced)->Next();
    ASSERT_TRUE(frame && *frame);
    indices.push_back((*frame)->index);
    // The stamp is that of the machine's clock.
    places.push_back(PlaceAt(trajectory, (*frame)->index, (*frame)->timestamp_ns).value_or(-1.0));
  }
  EXPECT_THAT(indices, ElementsAre(0, 1, 2, 3, 4, 5, 6));
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(places[i], static_cast<double>(i % 3), 1e-9) << i;
  }
  // Frames that are not played at a pace have the time of the recording.
  EXPECT_NEAR(PlaceAt(trajectory, 100, kPeriod_ns / 2).value_or(-1.0), 0.5, 1e-9);
  EXPECT_EQ(PlaceAt(trajectory, 100, 10 * kPeriod_ns), std::nullopt);
}

TEST(LiveTrajectory, SaysThatTheSessionEndedBeforeItWasAligned) {
  LiveTrajectory trajectory(Walk(), tests::SmallCameraOptions().scene, OpenBlank(std::nullopt));
  trajectory.Stop();
  EXPECT_EQ(trajectory.TakeNews(),
            "warning: walk.tum: was not aligned before the end. The marker alone places the "
            "objects.");
  EXPECT_EQ(PlaceAt(trajectory, 0, 0), std::nullopt);
}

TEST(LiveTrajectory, StopsWaitingAtCtrlC) {
  const InterruptGuard guard;
  LiveTrajectory trajectory(Walk(), tests::SmallCameraOptions().scene, OpenBlank(std::nullopt));
  raise(SIGINT);
  trajectory.Wait();
  EXPECT_THAT(trajectory.TakeNews().value_or(""), HasSubstr("was not aligned before the end"));
}

}  // namespace
}  // namespace pleinair::app
