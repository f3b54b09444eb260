// Runs with simulated GigE Vision cameras, in a network namespace with loopback only.
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "devices/cameras/camera_list.h"
#include "devices/cameras/live_camera.h"
#include "tests/vm/camera_helpers.h"

namespace pleinair::vm {
namespace {

using devices::CameraEvent;
using devices::LiveCamera;
using devices::LiveCameraOptions;
using devices::PixelFormat;
using std::chrono::milliseconds;
using testing::HasSubstr;
using Clock = std::chrono::steady_clock;
using Kind = CameraEvent::Kind;

constexpr const char* kWhole = "aravis:Aravis-Fake-WHOLE";
constexpr const char* kLossy = "aravis:Aravis-Fake-LOSSY";

LiveCameraOptions GreyOptions(const char* uri) {
  LiveCameraOptions options;
  options.uri = *devices::ParseCameraUri(uri);
  options.pictures.format = PixelFormat::kGrey8;
  options.stall_limit = milliseconds(1000);
  return options;
}

int CameraPid(int which) {
  const char* pids = std::getenv("ARV_CAM_PIDS");
  std::istringstream details(pids == nullptr ? "" : pids);
  int pid = 0;
  for (int i = 0; i <= which; ++i) details >> pid;
  return pid;
}

TEST(GigE, CamerasAreListedWithFormatsAndControls) {
  int found = 0;
  for (const devices::CameraDescription& camera : devices::ListCameras(true).cameras) {
    if (camera.uri != kWhole) continue;
    ++found;
    EXPECT_EQ(camera.serial, "WHOLE");
    EXPECT_FALSE(camera.formats.empty());
    EXPECT_FALSE(camera.controls.empty());
  }
  EXPECT_EQ(found, 1);
}

TEST(GigE, StampsAreBroughtFromTheWallClockToTheSteadyOne) {
  const auto camera = LiveCamera::Open(GreyOptions(kWhole));
  ASSERT_TRUE(camera);
  for (int i = 0; i < 5; ++i) {
    const auto frame = (*camera)->NextWithin(kLong);
    ASSERT_TRUE(frame);
    EXPECT_LT(std::abs(frame->timestamp_ns - *frame->arrival_ns), 50'000'000);
    EXPECT_FALSE(frame->grey.empty());
  }
}

TEST(GigE, ExposureAndGainAreHeldAndWhatIsLackingIsSaid) {
  LiveCameraOptions options = GreyOptions(kWhole);
  options.controls = {{devices::CameraControl::kExposure, 0.005},
                      {devices::CameraControl::kGain, 2.0},
                      {devices::CameraControl::kWhiteBalance, {}}};
  const auto camera = LiveCamera::Open(options);
  ASSERT_TRUE((*camera)->NextWithin(kLong));
  const auto results = (*camera)->ControlResults();
  ASSERT_EQ(results.size(), 3U);
  EXPECT_NEAR(results[0].value.value_or(0.0), 0.005, 1e-6);
  EXPECT_NEAR(results[1].value.value_or(0.0), 2.0, 1e-6);
  EXPECT_THAT(results[2].details, HasSubstr("no control of its white balance"));
}

TEST(GigE, LostPacketsAreSeenAndNoDamagedFrameIsDelivered) {
  const auto opened = LiveCamera::Open(GreyOptions(kLossy));
  ASSERT_TRUE(opened);
  LiveCamera& camera = **opened;
  for (int i = 0; i < 40; ++i) {
    const auto frame = camera.NextWithin(kLong);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->grey.width(), camera.negotiated()->size.width);
  }
  const auto transport = camera.transport();
  ASSERT_TRUE(transport);
  EXPECT_GT(transport->packet_size, 500);
  EXPECT_GT(transport->resent_packets + transport->missing_packets + transport->damaged, 0);
  EXPECT_EQ(camera.counts().loss.damaged, transport->damaged);
}

TEST(GigE, ASecondClientIsToldThatTheCameraIsTaken) {
  const auto first = LiveCamera::Open(GreyOptions(kWhole));
  ASSERT_TRUE((*first)->NextWithin(kLong));
  LiveCameraOptions options = GreyOptions(kWhole);
  options.wait_for_camera = false;
  const auto second = LiveCamera::Open(options);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().Message(), HasSubstr("another program"));
}

TEST(GigE, AFrozenCameraIsToldAndItsRecoveryToo) {
  const auto camera = LiveCamera::Open(GreyOptions(kWhole));
  ASSERT_TRUE((*camera)->NextWithin(kLong));
  kill(CameraPid(0), SIGSTOP);
  EXPECT_TRUE(WaitFor(camera->get(), Kind::kStalled));
  kill(CameraPid(0), SIGCONT);
  EXPECT_TRUE(WaitFor(camera->get(), Kind::kRecovered));
}

TEST(GigE, FiftyStartsAndStopsLeaveNothingBehind) {
  for (int round = 0; round < 50; ++round) {
    LiveCameraOptions options = GreyOptions(kWhole);
    options.wait_for_camera = false;
    const auto camera = LiveCamera::Open(options);
    ASSERT_TRUE(camera) << camera.error().Message();
    if (round % 10 == 0) {
      EXPECT_TRUE((*camera)->NextWithin(kLong));
    }
    std::thread stopper([&] { (*camera)->Stop(); });
    stopper.join();
  }
}

// Last test: the camera does not come back.
TEST(GigE, ZzzACameraThatIsSwitchedOffIsToldWithinASecond) {
  const auto camera = LiveCamera::Open(GreyOptions(kLossy));
  ASSERT_TRUE((*camera)->NextWithin(kLong));
  const std::int64_t killed_ns = Now_ns();
  kill(CameraPid(1), SIGKILL);
  const auto gone = WaitFor(camera->get(), Kind::kGone);
  ASSERT_TRUE(gone);
  EXPECT_LT(gone->time_ns - killed_ns, 1'000'000'000);
}

}  // namespace
}  // namespace pleinair::vm
