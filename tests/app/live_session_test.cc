#include "app/live/live_session.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <thread>

#include "app/live/live_light.h"
#include "devices/recording.h"
#include "tests/app/small_camera.h"
#include "tests/compositor/light_scenes.h"

namespace pleinair::app {
namespace {

using std::chrono::milliseconds;

/// A folder of its own for one test, gone afterwards.
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

/// Grey frames, as fast as they are taken or with a pause before each.
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
    frame.rgb = RgbImage(kSmallWidth, kSmallHeight, 3);
    frame.grey = GreyImage(kSmallWidth, kSmallHeight, 1);
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
  LiveOptions options = SmallCameraOptions();
  options.start = *UtcTime::Parse("2025-09-14T11:05:00Z");
  return options;
}

/// Draws all frames; gives the first byte of each picture.
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
    std::this_thread::sleep_for(milliseconds(15));
  }
  (*session)->Stop();
  const LiveStatistics statistics = (*session)->statistics();
  EXPECT_EQ(statistics.captured, 60);
  EXPECT_EQ(statistics.tracked + statistics.late_for_tracking, 60);
  EXPECT_EQ(statistics.drawn + statistics.late_for_drawing, statistics.tracked);
  EXPECT_GT(statistics.late_for_drawing, 0) << "the renderer was to be slower";
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
    while ((*session)->statistics().captured < 20) std::this_thread::yield();
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
  EXPECT_EQ(statistics.recorded + statistics.left_out_of_recording, 30);
  EXPECT_EQ(statistics.left_out_of_recording, 0);
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
    EXPECT_LT((*session)->statistics().captured, 100000);
  }
}

TEST(LiveSession, SaysSoWhereTheCamerasSizeIsNotTheCalibrations) {
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

/// A box on level ground.
LiveLight::Setup BoxOnGround() {
  using compositor::testing::BoxModel;
  using compositor::testing::Ground;
  LiveLight::Setup setup;
  setup.camera = Options().camera;
  setup.scene = Options().scene;
  setup.scene.place_time.start = *Options().start;
  setup.scene.phantoms.emplace_back();
  setup.scene.objects.emplace_back();
  setup.placed = {
      compositor::testing::Phantom(Ground(0.6, {0.3F, 0.3F, 0.3F})),
      compositor::testing::Object(BoxModel({0, 0, 0}, {0.3, 0.3, 0.3}, {0.5F, 0.4F, 0.3F}))};
  setup.edit = UneditedScene(setup.scene, {});
  setup.skies.source = StatedSky(setup.scene);
  setup.time = *Options().start;
  return setup;
}

TEST(LiveLight, RelightsAMovedObjectWhileOthersLookOn) {
  const LiveLight::Setup setup = BoxOnGround();
  SceneEdit edit = setup.edit;
  auto light = LiveLight::Create(setup);
  ASSERT_TRUE(light) << light.error().Message();
  std::shared_ptr<const SceneLight> in_use = (*light)->Take();
  ASSERT_NE(in_use, nullptr) << "the first light is there at once";
  const auto until_coefficients = [&] {
    int seen_without = 0;
    while (!in_use->order.coefficients || in_use->objects != edit.objects) {
      if (auto newest = (*light)->Take()) in_use = newest;
      seen_without += in_use->order.coefficients ? 0 : 1;
      std::this_thread::sleep_for(milliseconds(1));
    }
    return seen_without;
  };
  EXPECT_GT(until_coefficients(), 0) << "frames were drawn before, by light that was traced";
  const auto before = in_use;
  edit.objects[0].translation_m = {-0.3, 0.1, 0.0};
  (*light)->SetEdit(edit);
  EXPECT_EQ((*light)->Take(), nullptr) << "asking does not wait; the last light stays";
  EXPECT_GT(until_coefficients(), 0);
  EXPECT_NE(in_use->order.solver, before->order.solver);
  while ((*light)->progress().coefficients < 1.0) std::this_thread::sleep_for(milliseconds(1));
  (*light)->Stop();
  // What came of it is what is made from nothing for that place.
  compositor::CoefficientOptions options;
  options.convergence = edit.convergence;
  const auto fresh = in_use->order.solver->Coefficients(
      MarkerFromWorld(setup.scene.marker) * Vec3{0, 0, 1}, options, {});
  const auto meshes =
      in_use->order.solver->Relight(fresh, in_use->daylight, in_use->marker_from_world);
  ASSERT_EQ(meshes.size(), in_use->meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    EXPECT_EQ(meshes[i].ambient_with, in_use->meshes[i].ambient_with);
  }
}

TEST(LiveLight, LeavesTheShadeOfTreesOutUnderTheSunOfAnotherHour) {
  LiveLight::Setup setup = BoxOnGround();
  const Vec3 to_sun =
      MarkerFromWorld(setup.scene.marker) * SunOver(setup.scene.place_time, setup.time).ToSun().xyz;
  const std::vector<compositor::SunlitSpot> spots{{{0, 0, 0}, 0.2, 0.01}};
  setup.skies.sunlight =
      std::make_shared<const compositor::SeenSunlight>(compositor::MapSeenSunlight(to_sun, spots));
  auto light = LiveLight::Create(setup);
  ASSERT_TRUE(light) << light.error().Message();
  const auto has_map = [&](double later_s, double heading_deg) {
    SceneEdit edit = setup.edit;
    edit.later_s = later_s;
    edit.heading_deg = heading_deg;
    (*light)->SetEdit(edit);
    // A sanitized build on a busy machine takes some ten seconds a light.
    for (int i = 0; i < 60'000; ++i) {
      const auto newest = (*light)->Take();
      if (newest && newest->order.time == setup.time.PlusSeconds(later_s) &&
          std::fabs(ToDegrees(newest->order.marker.heading) - heading_deg) < 1e-9) {
        return newest->order.skies.sunlight != nullptr;
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
    ADD_FAILURE() << "no light came";
    return false;
  };
  EXPECT_TRUE(has_map(300, 0)) << "five minutes move the sun by little more than a degree";
  EXPECT_FALSE(has_map(2 * 3600, 0));
  EXPECT_TRUE(has_map(299, 0)) << "it is still there for the hour that it was made for";
  EXPECT_FALSE(has_map(299, 30));
}

TEST(HandOver, ReplacesWaitsOrRefusesWhenItIsFull) {
  HandOver<int> newest(1, WhenFull::kReplaceOldest);
  EXPECT_TRUE(newest.Give(1));
  EXPECT_TRUE(newest.Give(2));
  EXPECT_EQ(newest.Take(), 2);
  EXPECT_EQ(newest.dropped(), 1);
  HandOver<int> refusing(1, WhenFull::kRefuse);
  EXPECT_TRUE(refusing.Give(1));
  EXPECT_FALSE(refusing.Give(2));
  EXPECT_EQ(refusing.Take(), 1);
  HandOver<int> waiting(1, WhenFull::kWait);
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
