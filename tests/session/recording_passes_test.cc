#include "session/recording_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/source_tree.h"

namespace pleinair::session {
namespace {

/// Six frames of an AprilTag and a virtual object.
std::filesystem::path Tag() { return tests::SourceTree() / "recordings" / "courtyard_tag36h11"; }

TEST(RecordingPasses, ComposeEveryFrameInOrder) {
  std::vector<std::int64_t> indices;
  const auto done = ComposeRecording(
      Tag(), {}, [&](const devices::Frame& frame, const ComposedFrame& composed) -> Result<void> {
        indices.push_back(frame.index);
        EXPECT_TRUE(composed.pose);
        EXPECT_EQ(composed.image.width(), 640);
        return {};
      });
  ASSERT_TRUE(done) << done.error().Message();
  EXPECT_EQ(indices, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
}

TEST(RecordingPasses, TellTheirProgressAndTheirTimes) {
  auto recording = devices::OpenRecording(Tag());
  ASSERT_TRUE(recording);
  auto pipeline = Pipeline::Create(recording->camera, *recording->scene);
  ASSERT_TRUE(pipeline);
  std::vector<std::int64_t> done;
  StageTimes times;
  const PassMonitor monitor{
      [&](std::int64_t count, std::optional<std::int64_t> of) -> Result<void> {
        EXPECT_EQ(of, 6);
        done.push_back(count);
        return {};
      },
      &times};
  int tracked = 0;
  ASSERT_TRUE(TrackRecording(
      **pipeline, *std::move(recording),
      [&](const devices::Frame& frame, const TrackedFrame& of_frame) -> Result<void> {
        EXPECT_EQ(frame.index, tracked++);
        EXPECT_EQ(of_frame.observations.size(), 1U);
        return {};
      },
      monitor));
  EXPECT_EQ(tracked, 6);
  EXPECT_EQ(done.front(), 0);
  EXPECT_EQ(done.back(), 6);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  std::vector<std::string> stages;
  for (const StageTimes::Summary& stage : times.Summarize()) {
    stages.push_back(stage.stage);
    EXPECT_EQ(stage.runs, stage.stage == "read" ? 7U : 6U) << stage.stage;
  }
  EXPECT_EQ(stages, (std::vector<std::string>{"track", "measure", "read"}));
}

TEST(RecordingPasses, StopWhereTheyAreToldTo) {
  auto recording = devices::OpenRecording(Tag());
  ASSERT_TRUE(recording);
  auto pipeline = Pipeline::Create(recording->camera, *recording->scene);
  ASSERT_TRUE(pipeline);
  const PassMonitor monitor{[](std::int64_t, std::optional<std::int64_t>) -> Result<void> {
    return SystemError("", "stopped");
  }};
  const auto tracked = TrackRecording(**pipeline, *std::move(recording), {}, monitor);
  ASSERT_FALSE(tracked);
  EXPECT_EQ(tracked.error().what, "stopped");
  EXPECT_EQ((*pipeline)->tracks().frames(), 0);

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
