#include "session/recording_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/source_tree.h"

namespace pleinair::session {
namespace {

/// Six frames of an AprilTag and a virtual object.
std::filesystem::path Tag() { return tests::SourceTree() / "recordings" / "courtyard_tag36h11"; }

/// The same six frames four times: more than are processed at once.
class RepeatedFrames : public devices::FrameSource {
 public:
  static constexpr std::int64_t kFrames = 24;

  explicit RepeatedFrames(std::unique_ptr<devices::FrameSource> source) {
    while (auto frame = source->Next().value()) frames_.push_back(*std::move(frame));
  }
  Result<std::optional<devices::Frame>> Next() override {
    if (next_ == kFrames) return std::nullopt;
    devices::Frame frame = frames_[static_cast<std::size_t>(next_) % frames_.size()];
    frame.index = next_;
    frame.timestamp_ns = next_++ * 1'000'000'000;
    return frame;
  }
  std::optional<std::int64_t> FrameCount() const override { return kFrames; }

 private:
  std::vector<devices::Frame> frames_;
  std::int64_t next_ = 0;
};

/// The repeated frames and their pipeline; nothing is drawn.
struct Tracking {
  devices::Recording recording;
  std::unique_ptr<Pipeline> pipeline;

  Tracking() : recording(devices::OpenRecording(Tag()).value()) {
    recording.scene->objects.clear();
    recording.frames = std::make_unique<RepeatedFrames>(std::move(recording.frames));
    pipeline = Pipeline::Create(recording.camera, *recording.scene).value();
  }
};

TEST(TrackRecording, GivesFramesInOrderWithProgressAndTimes) {
  Tracking tracking;
  std::vector<std::int64_t> done;
  StageTimes times;
  const PassMonitor monitor{
      [&](std::int64_t count, std::optional<std::int64_t> of) -> Result<void> {
        EXPECT_EQ(of, RepeatedFrames::kFrames);
        done.push_back(count);
        return {};
      },
      &times};
  std::int64_t tracked = 0;
  ASSERT_TRUE(TrackRecording(
      *tracking.pipeline, std::move(tracking.recording),
      [&](const devices::Frame& frame, const TrackedFrame& of_frame) -> Result<void> {
        EXPECT_EQ(frame.index, tracked++);
        EXPECT_EQ(of_frame.observations.size(), 1U);
        return {};
      },
      monitor));
  EXPECT_EQ(tracked, RepeatedFrames::kFrames);
  EXPECT_EQ(done.front(), 0);
  EXPECT_EQ(done.back(), RepeatedFrames::kFrames);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  std::vector<std::string> stages;
  for (const StageTimes::Summary& stage : times.Summarize()) {
    stages.push_back(stage.stage);
    // The end of the recording counts as a read too.
    EXPECT_EQ(stage.runs, stage.stage == "read" ? 25U : 24U) << stage.stage;
  }
  EXPECT_EQ(stages, (std::vector<std::string>{"track", "measure", "read"}));
}

TEST(TrackRecording, StopsAtAnErrorWhileFramesAreOnTheirWay) {
  Tracking tracking;
  int tracked = 0;
  const auto stopped =
      TrackRecording(*tracking.pipeline, std::move(tracking.recording),
                     [&](const devices::Frame& frame, const TrackedFrame&) -> Result<void> {
                       ++tracked;
                       return frame.index < 11 ? Result<void>() : SystemError("disk", "is full");
                     });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().where, "disk");
  EXPECT_EQ(tracked, 12);
}

TEST(TrackRecording, StopsWhereTheMonitorSaysSo) {
  Tracking tracking;
  const PassMonitor monitor{[](std::int64_t done, std::optional<std::int64_t>) -> Result<void> {
    return done < 8 ? Result<void>() : SystemError("", "stopped");
  }};
  const auto tracked =
      TrackRecording(*tracking.pipeline, std::move(tracking.recording), {}, monitor);
  ASSERT_FALSE(tracked);
  EXPECT_EQ(tracked.error().what, "stopped");
}

TEST(ComposeRecording, ComposesEveryFrameInOrder) {
  std::vector<std::int64_t> indices;
  const auto done = ComposeRecording(
      Tag(), {}, [&](const devices::Frame& frame, const ComposedFrame& composed) -> Result<void> {
        indices.push_back(frame.index);
        EXPECT_TRUE(composed.pose);
        EXPECT_TRUE(composed.light);
        EXPECT_EQ(composed.image.width(), 640);
        return {};
      });
  ASSERT_TRUE(done) << done.error().Message();
  EXPECT_EQ(indices, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
}

TEST(ComposeRecording, StopsAtTheFirstErrorOfItsCaller) {
  int composed = 0;
  const auto done =
      ComposeRecording(Tag(), {}, [&](const devices::Frame&, const ComposedFrame&) -> Result<void> {
        ++composed;
        return InputError("out", "cannot be written");
      });
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().where, "out");
  EXPECT_EQ(composed, 1);
}

}  // namespace
}  // namespace pleinair::session
