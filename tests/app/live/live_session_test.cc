#include "app/live/live_session.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>

#include "devices/recordings/recording.h"
#include "tests/small_camera.h"

namespace pleinair::app {
namespace {

using std::chrono::milliseconds;

/// A temporary folder for one test, removed afterwards.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::path(testing::TempDir()) / ("live_" + std::to_string(getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Grey frames, without delay or with a pause before each.
class GreyFrames : public devices::FrameSource {
 public:
  GreyFrames(int count, milliseconds pause) : count_(count), pause_(pause) {}

  Result<std::optional<devices::Frame>> Next() override {
    if (next_ >= count_) return std::nullopt;
    std::this_thread::sleep_for(pause_);
    devices::Frame frame;
    frame.index = next_;
    frame.timestamp_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(
                             std::chrono::steady_clock::now().time_since_epoch())
                             .count();
    frame.lost_before = next_ == 3 ? 2 : 0;
    frame.loss.by_number = frame.lost_before;
    frame.rgb = RgbImage(tests::kSmallWidth, tests::kSmallHeight, 3);
    frame.grey = GreyImage(tests::kSmallWidth, tests::kSmallHeight, 1);
    std::fill_n(frame.rgb.data(), frame.rgb.size(), static_cast<std::uint8_t>(next_));
    ++next_;
    return frame;
  }
  std::optional<std::int64_t> FrameCount() const override { return count_; }

 private:
  int count_;
  milliseconds pause_;
  int next_ = 0;
};

LiveOptions Options() {
  LiveOptions options = tests::SmallCameraOptions();
  options.start = *UtcTime::Parse("2025-09-14T11:05:00Z");
  return options;
}

/// Draws all frames and returns the first byte of each image.
std::vector<int> DrawAll(LiveSession* session) {
  std::vector<int> seen;
  while (!session->finished()) {
    const auto drawn = session->Draw(milliseconds(20));
    EXPECT_TRUE(drawn);
    if (!drawn) break;
    if (*drawn) seen.push_back((*drawn)->picture(0, 0));
  }
  return seen;
}

TEST(LiveSession, LosslessDrawsEveryFrameInOrder) {
  LiveOptions options = Options();
  options.lossless = true;
  auto session =
      LiveSession::Create(std::make_unique<GreyFrames>(40, milliseconds(0)), std::move(options));
  ASSERT_TRUE(session);
  const std::vector<int> seen = DrawAll(session->get());
  ASSERT_EQ(seen.size(), 40U);
  for (int i = 0; i < 40; ++i) EXPECT_EQ(seen[static_cast<std::size_t>(i)], i);
}

TEST(LiveSession, AccountsForEveryFrameWhileASlowRendererLagsBehind) {
  auto session = LiveSession::Create(std::make_unique<GreyFrames>(60, milliseconds(3)), Options());
  ASSERT_TRUE(session);
  std::vector<int> seen;
  while (!(*session)->finished()) {
    const auto drawn = (*session)->Draw(milliseconds(20));
    ASSERT_TRUE(drawn);
    if (*drawn) seen.push_back((*drawn)->picture(0, 0));
    const LiveStatistics meanwhile = (*session)->statistics();
    EXPECT_GE(meanwhile.Unaccounted(), 0);
    EXPECT_LE(meanwhile.Unaccounted(), 5);
    std::this_thread::sleep_for(milliseconds(15));
  }
  (*session)->Stop();
  const LiveStatistics statistics = (*session)->statistics();
  EXPECT_EQ(statistics.frames.captured, 60);
  EXPECT_EQ(statistics.frames.tracked + statistics.late.for_tracking, 60);
  EXPECT_EQ(statistics.frames.drawn + statistics.late.for_drawing, statistics.frames.tracked);
  EXPECT_GT(statistics.late.for_drawing, 0) << "the renderer was to be slower";
  EXPECT_EQ(statistics.loss.by_number, 2);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 59) << "the newest frame is drawn last";
  EXPECT_GT(statistics.latency.worst_ms, 0.0);
  EXPECT_EQ(statistics.Unaccounted(), 0);
}

TEST(LiveSession, CountsFramesThatItsEndCutsOff) {
  for (int round = 0; round < 5; ++round) {
    auto session =
        LiveSession::Create(std::make_unique<GreyFrames>(1000, milliseconds(1)), Options());
    ASSERT_TRUE(session);
    while ((*session)->statistics().frames.captured < 20) std::this_thread::yield();
    (*session)->Stop();
    const LiveStatistics statistics = (*session)->statistics();
    EXPECT_GE(statistics.on_the_way_at_end, 1) << "nobody has drawn";
    EXPECT_LE(statistics.on_the_way_at_end, 5);
    EXPECT_EQ(statistics.Unaccounted(), 0);
  }
}

TEST(LatencyHistogram, GivesMedianAndNinetyFifthPercentOfAnyNumberOfLatencies) {
  LatencyHistogram latencies;
  EXPECT_EQ(latencies.Summarize().median_ms, 0.0);
  for (int i = 1; i <= 10000; ++i) latencies.Add(i * 0.1);
  const LatencyMeter::Summary summary = latencies.Summarize();
  EXPECT_NEAR(summary.median_ms, 500.0, 10.0);
  EXPECT_NEAR(summary.p95_ms, 950.0, 19.0);
  EXPECT_EQ(summary.worst_ms, 1000.0);
  latencies.Add(1e9);
  latencies.Add(0.0);
  EXPECT_EQ(latencies.Summarize().worst_ms, 1e9);
}

TEST(LiveSession, RecordsEveryFrameOnItsOwnThreadAndTheRecordingOpens) {
  const Folder folder;
  LiveOptions options = Options();
  options.record = folder / "take";
  auto session =
      LiveSession::Create(std::make_unique<GreyFrames>(30, milliseconds(2)), std::move(options));
  ASSERT_TRUE(session);
  DrawAll(session->get());
  (*session)->Stop();
  EXPECT_FALSE((*session)->recording_trouble());
  const LiveStatistics statistics = (*session)->statistics();
  EXPECT_EQ(statistics.recording.recorded + statistics.recording.left_out, 30);
  EXPECT_EQ(statistics.recording.left_out, 0);
  const auto recording = devices::OpenRecording(folder / "take");
  ASSERT_TRUE(recording) << recording.error().Message();
  EXPECT_EQ(recording->frames->FrameCount(), 30);
  ASSERT_TRUE(recording->scene);
  EXPECT_EQ(recording->scene->marker.family, "tag36h11");
  EXPECT_EQ(recording->scene->place_time.start.ToString(), "2025-09-14T11:05:00Z");
  for (int i = 0; i < 30; ++i) {
    const auto frame = recording->frames->Next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ((*frame)->rgb(5, 5, 1), i);
  }
}

TEST(LiveSession, RefusesAFolderThatHoldsARecording) {
  const Folder folder;
  for (const bool second : {false, true}) {
    LiveOptions options = Options();
    options.record = folder / "take";
    auto session =
        LiveSession::Create(std::make_unique<GreyFrames>(1, milliseconds(0)), std::move(options));
    EXPECT_EQ(session.has_value(), !second);
    if (session) DrawAll(session->get());
  }
}

TEST(LiveSession, StopsInTheMiddleWithoutWaitingForTheSource) {
  for (int round = 0; round < 10; ++round) {
    auto session =
        LiveSession::Create(std::make_unique<GreyFrames>(100000, milliseconds(1)), Options());
    ASSERT_TRUE(session);
    EXPECT_TRUE((*session)->Draw(milliseconds(200)));
    (*session)->Stop();
    EXPECT_LT((*session)->statistics().frames.captured, 100000);
  }
}

TEST(LiveSession, ReportsSoWhereTheCamerasSizeIsNotTheCalibrations) {
  LiveOptions options = Options();
  options.camera.width = 320;
  auto session =
      LiveSession::Create(std::make_unique<GreyFrames>(5, milliseconds(0)), std::move(options));
  ASSERT_TRUE(session);
  Result<std::optional<DrawnFrame>> drawn = std::nullopt;
  while (drawn && !(*session)->finished()) drawn = (*session)->Draw(milliseconds(20));
  if (drawn) drawn = (*session)->Draw(milliseconds(0));
  ASSERT_FALSE(drawn);
  EXPECT_THAT(drawn.error().what, testing::HasSubstr("160x120"));
}

TEST(BoundedQueue, ReplacesWaitsOrRefusesWhenItIsFull) {
  BoundedQueue<int> newest(1, WhenFull::kReplaceOldest);
  EXPECT_TRUE(newest.Give(1));
  EXPECT_TRUE(newest.Give(2));
  EXPECT_EQ(newest.Take(), 2);
  EXPECT_EQ(newest.dropped(), 1);
  BoundedQueue<int> refusing(1, WhenFull::kRefuse);
  EXPECT_TRUE(refusing.Give(1));
  EXPECT_FALSE(refusing.Give(2));
  EXPECT_EQ(refusing.Take(), 1);
  BoundedQueue<int> waiting(1, WhenFull::kWait);
  std::thread giver([&] {
    for (int i = 0; i < 100; ++i) waiting.Give(i);
    waiting.Close();
  });
  for (int i = 0; i < 100; ++i) EXPECT_EQ(waiting.Take(), i);
  EXPECT_EQ(waiting.Take(), std::nullopt);
  EXPECT_TRUE(waiting.finished());
  giver.join();
}

}  // namespace
}  // namespace pleinair::app
