// Runs inside the VM: libcamera on uvcvideo, its pipeline for USB cameras.
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "devices/cameras/camera_list.h"
#include "tests/vm/camera_helpers.h"
#include "tests/vm/uvc_simulator.h"

namespace pleinair::vm {
namespace {

using devices::CameraControl;
using devices::LiveCamera;
using devices::LiveCameraOptions;
using devices::PixelFormat;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kFirst = "libcamera:0";

TEST(Libcamera, DeliversFramesInOrderWithStampsOnTheSteadyClock) {
  const UvcSimulator simulator;
  for (const PixelFormat format : {PixelFormat::kYuyv, PixelFormat::kMjpeg}) {
    const auto camera = Open(Options(kFirst, format, 320, 240, 15.0));
    std::int64_t last_ns = 0, last_index = -1;
    for (int i = 0; i < 8; ++i) {
      const auto frame = camera->NextWithin(kLong);
      ASSERT_TRUE(frame);
      EXPECT_EQ(frame->grey.width(), 320);
      EXPECT_GT(frame->timestamp_ns, last_ns);
      EXPECT_GT(frame->index, last_index);
      EXPECT_EQ(frame->stamp_meaning, devices::StampMeaning::kExposureStart);
      EXPECT_LT(std::abs(*frame->arrival_ns - frame->timestamp_ns), 200'000'000);
      // The simulator's ramp, not one grey.
      EXPECT_NE(frame->grey(3, 120), frame->grey(40, 120));
      last_ns = frame->timestamp_ns;
      last_index = frame->index;
    }
    EXPECT_EQ(camera->negotiated()->format, format);
  }
  int listed = 0;
  for (const devices::CameraDescription& camera : devices::ListCameras(false).cameras) {
    if (camera.driver != "libcamera") continue;
    ++listed;
    EXPECT_THAT(camera.uri, StartsWith("libcamera:"));
    EXPECT_EQ(camera.formats.size(), 2U);
    EXPECT_EQ(camera.controls.size(), 4U);
  }
  EXPECT_EQ(listed, 1);
}

TEST(Libcamera, HoldsControlsThroughTheNodeAndReadsThemBack) {
  UvcSimulator simulator;
  LiveCameraOptions options = Options(kFirst, PixelFormat::kYuyv, 320, 240, 15.0);
  options.controls = {{CameraControl::kExposure, 0.01}, {CameraControl::kWhiteBalance, 5000.0}};
  const auto camera = Open(options);
  std::optional<devices::Frame> frame;
  for (int i = 0; i < 4; ++i) frame = camera->NextWithin(kLong);
  ASSERT_TRUE(frame);
  ASSERT_EQ(camera->ControlResults().size(), 2U);
  for (const devices::ControlResult& result : camera->ControlResults()) {
    EXPECT_TRUE(result.locked) << result.details;
    EXPECT_EQ(result.details, "");
  }
  EXPECT_NEAR(frame->settings.exposure_s.value_or(0.0), 0.01, 1e-9);
  EXPECT_NEAR(frame->settings.white_balance_k.value_or(0.0), 5000.0, 1e-9);
  EXPECT_THAT(simulator.Output(), HasSubstr("ctrl 1 0x04 100"));
  EXPECT_THAT(simulator.Output(), HasSubstr("ctrl 2 0x0a 5000"));
}

TEST(Libcamera, ABusyOrMissingCameraIsToldInWords) {
  const UvcSimulator simulator;
  const auto first = Open(Options(kFirst, PixelFormat::kYuyv, 320, 240, 15.0));
  ASSERT_TRUE(first->NextWithin(kLong));
  LiveCameraOptions options = Options(kFirst, PixelFormat::kYuyv, 320, 240, 15.0);
  options.wait_for_camera = false;
  const auto second = LiveCamera::Open(options);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().Message(), HasSubstr("another program uses the camera"));
  options.uri = *devices::ParseCameraUri("libcamera:none");
  const auto none = LiveCamera::Open(options);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().Message(), HasSubstr("there is no such camera"));
}

TEST(Libcamera, AnUnpluggedCameraIsToldWithinASecondAndComesBackByItself) {
  UvcSimulator simulator({"--unplug-after", "10", "--replug-ms", "1500"});
  LiveCameraOptions options = Options(kFirst, PixelFormat::kYuyv, 320, 240, 15.0);
  const auto camera = Open(options);
  const Replug replug = WatchReplug(camera.get());
  EXPECT_LT(replug.reported_after_ns, 1'000'000'000);
  ASSERT_TRUE(replug.back) << simulator.Output();
  EXPECT_TRUE(camera->NextWithin(kLong));
  EXPECT_EQ(camera->counts().connections, 2);
}

/// Delays udev's report of nodes of one kind by a second; of no kind after destruction.
class SlowNodes {
 public:
  SlowNodes() {
    std::filesystem::create_directories(kRules.parent_path());
    std::ofstream rules(kRules);
    for (const char* kind : {"media", "video4linux"}) {
      rules << "SUBSYSTEM==\"" << kind << "\", PROGRAM=\"/bin/sh -c 'test ! -e /run/slow-" << kind
            << " || sleep 1'\"\n";
    }
    rules.close();
    EXPECT_EQ(std::system("udevadm control --reload"), 0);
  }
  ~SlowNodes() {
    Are("");
    std::filesystem::remove(kRules);
    EXPECT_EQ(std::system("udevadm control --reload"), 0);
  }
  void Are(const std::string& kind) {
    if (!file_.empty()) std::filesystem::remove(file_);
    file_ = kind.empty() ? "" : "/run/slow-" + kind;
    if (!file_.empty()) std::ofstream(file_) << "slow";
  }

 private:
  const std::filesystem::path kRules = "/run/udev/rules.d/10-slow-nodes.rules";
  std::filesystem::path file_;
};

std::size_t MediaNodes() {
  std::size_t count = 0;
  for (const auto& each : std::filesystem::directory_iterator("/dev")) {
    count += each.path().filename().string().starts_with("media") ? 1 : 0;
  }
  return count;
}

/// Waits until there are `count` and udev has reported them.
void WaitForMediaNodes(std::size_t count) {
  for (const auto end = std::chrono::steady_clock::now() + kLong;
       MediaNodes() != count && std::chrono::steady_clock::now() < end;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(MediaNodes(), count);
  EXPECT_EQ(std::system("udevadm settle -t 20"), 0);
}

// A manager that listens crashes here: it frees what it waits for at the first round and reads it
// at the second, when the video node comes first.
TEST(Libcamera, AnotherCameraThatComesAndGoesInAnyOrderOfNodesHarmsNobody) {
  const UvcSimulator simulator;
  const auto camera = Open(Options(kFirst, PixelFormat::kYuyv, 320, 240, 15.0));
  ASSERT_TRUE(camera->NextWithin(kLong));
  const std::size_t alone = MediaNodes();
  SlowNodes slow;
  for (const char* kind : {"video4linux", "media"}) {
    slow.Are(kind);
    {
      const UvcSimulator other({"--port", "1"});
      WaitForMediaNodes(alone + 1);
    }
    WaitForMediaNodes(alone);
    EXPECT_TRUE(camera->NextWithin(kLong));
  }
  EXPECT_EQ(camera->counts().connections, 1);
}

TEST(Libcamera, StartsAndStopsLeaveNothingBehind) {
  const UvcSimulator simulator;
  for (int round = 0; round < 6; ++round) {
    const auto camera = Open(Options(kFirst, PixelFormat::kYuyv, 320, 240, 15.0));
    ASSERT_NE(camera, nullptr);
    if (round % 3 == 0) {
      EXPECT_TRUE(camera->NextWithin(kLong));
    }
    std::thread stopper([&] { camera->Stop(); });
    stopper.join();
  }
  const auto again = Open(Options(kFirst, PixelFormat::kYuyv, 320, 240, 15.0));
  EXPECT_TRUE(again->NextWithin(kLong)) << "a camera left acquired would be busy";
}

}  // namespace
}  // namespace pleinair::vm
