// Runs inside the VM, on the kernel's own drivers: docs/measurements/capture.md lists the
// behaviours.
#include <gmock/gmock.h>

#include "tests/vm/camera_helpers.h"
#include "tests/vm/uvc_simulator.h"

namespace pleinair::vm {
namespace {

using devices::LiveCameraOptions;
using devices::PixelFormat;
using std::chrono::milliseconds;
using Kind = devices::CameraEvent::Kind;

TEST(Behaviour6And7, AnUnpluggedCameraIsToldWithinASecondAndComesBackByItself) {
  UvcSimulator simulator({"--unplug-after", "10", "--replug-ms", "1500"});
  LiveCameraOptions options = Options(kUsb, PixelFormat::kYuyv, 320, 240);
  options.controls = {{devices::CameraControl::kExposure, 0.02}};
  const auto camera = Open(options);
  const Replug replug = WatchReplug(camera.get());
  EXPECT_LT(replug.reported_after_ns, 1'000'000'000);
  ASSERT_TRUE(replug.back) << simulator.Output();
  ASSERT_TRUE(camera->NextWithin(kLong));
  EXPECT_EQ(camera->counts().connections, 2);
  ASSERT_EQ(camera->ControlResults().size(), 1U);
  EXPECT_TRUE(camera->ControlResults()[0].locked) << "controls are held again after the replug";
}

TEST(Behaviour8, ASilentCameraIsToldAndItsRecoveryToo) {
  UvcSimulator simulator({"--stall-after", "10"});
  LiveCameraOptions options = Options(kUsb, PixelFormat::kYuyv, 320, 240);
  options.stall_limit = milliseconds(1000);
  const auto camera = Open(options);
  EXPECT_TRUE(WaitFor(camera.get(), Kind::kStalled));
  simulator.Command("run");
  EXPECT_TRUE(WaitFor(camera.get(), Kind::kRecovered));
  EXPECT_EQ(camera->counts().stalls, 1);
}

// Last test: vivid's node does not come back.
TEST(Behaviour6, ZzzVividsDisconnectIsTold) {
  const std::string node = VividNode();
  const auto camera = Open(Options(node, PixelFormat::kYuyv, 320, 180));
  ASSERT_TRUE(camera->NextWithin(kLong));
  const std::int64_t pulled_ns = Now_ns();
  SetByName(node, "Disconnect", 1);
  const auto gone = WaitFor(camera.get(), Kind::kGone);
  ASSERT_TRUE(gone);
  EXPECT_LT(gone->time_ns - pulled_ns, 1'000'000'000);
}

}  // namespace
}  // namespace pleinair::vm
