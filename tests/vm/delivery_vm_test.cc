// Runs inside the VM, on the kernel's own drivers: docs/measurements/capture.md lists the
// behaviours.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <thread>

#include "tests/vm/camera_helpers.h"
#include "tests/vm/uvc_simulator.h"

namespace pleinair::vm {
namespace {

using devices::FrameLoss;
using devices::PixelFormat;
using std::chrono::milliseconds;

TEST(Behaviour1, ASleepingConsumerNeitherStarvesTheDriverNorGetsOldFrames) {
  const auto camera = Open(Options(VividNode(), PixelFormat::kYuyv, 320, 180));
  ASSERT_TRUE(camera->NextWithin(kLong));
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(camera->NextWithin(kLong));
  std::this_thread::sleep_for(milliseconds(1000));
  const std::int64_t before = Now_ns();
  const auto frame = camera->NextWithin(kLong);
  ASSERT_TRUE(frame);
  std::cout << "lost in 1 s of sleep: " << frame->lost_before << " (number "
            << frame->loss.by_number << ", not taken " << frame->loss.not_taken << ", time "
            << frame->loss.by_time << "), age " << (before - frame->timestamp_ns) / 1000 << " us\n";
  // With only four driver buffers the frame would be one second old.
  EXPECT_LT(before - frame->timestamp_ns, 2 * 33'400'000);
  // 29 at 30 Hz; fewer in the VM of a busy machine.
  EXPECT_GE(frame->lost_before, 20);
  EXPECT_LE(frame->lost_before, 31);
  EXPECT_LE(frame->loss.by_number, 3) << "the driver ran out of buffers";
}

void SetNoDrop(int value) { std::ofstream("/sys/module/uvcvideo/parameters/nodrop") << value; }

TEST(Behaviour2, DamagedFramesThatTheDriverDropsShowAsAGapInItsNumbers) {
  SetNoDrop(0);
  const UvcSimulator simulator({"--err-every", "5"});
  const auto camera = Open(Options(kUsb, PixelFormat::kYuyv, 320, 240, 15.0));
  const FrameLoss loss = Collect(camera.get(), 24);
  EXPECT_GE(loss.by_number, 5);
  EXPECT_LE(loss.by_number, 7);
  EXPECT_EQ(loss.damaged, 0);
}

TEST(Behaviour2, DamagedFramesThatTheDriverHandsOnAreCountedAndNotDelivered) {
  SetNoDrop(1);
  const UvcSimulator simulator({"--err-every", "5"});
  const auto camera = Open(Options(kUsb, PixelFormat::kYuyv, 320, 240, 15.0));
  const FrameLoss loss = Collect(camera.get(), 24);
  SetNoDrop(0);
  EXPECT_GE(loss.damaged, 5);
  EXPECT_LE(loss.damaged, 7);
  EXPECT_LE(loss.by_number, 3) << "these did not come through as damaged";
}

TEST(Behaviour2, FramesThatTheCameraNeverSentShowAsADoubledTimeStep) {
  // At a low rate, so that delays of a busy machine's VM are a small part of a period.
  const UvcSimulator simulator({"--drop-every", "5", "--fps", "8"});
  const auto camera = Open(Options(kUsb, PixelFormat::kYuyv, 320, 240));
  const FrameLoss loss = Collect(camera.get(), 40);
  // Ten are missing; the first few precede the estimate of the period.
  EXPECT_GE(loss.by_time, 5);
  EXPECT_LE(loss.by_time, 20);
  EXPECT_LT(loss.by_number, loss.by_time);
  EXPECT_EQ(loss.damaged, 0);
}

TEST(Behaviour3, StampsAreOnTheSteadyClockWithTheMeaningThatTheDriverGives) {
  const std::string node = VividNode();
  for (const int source : {0, 1}) {
    SetByName(node, "Timestamp Source", source);
    const auto camera = Open(Options(node, PixelFormat::kYuyv, 320, 180));
    const auto frame = camera->NextWithin(kLong);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->stamp_meaning, source == 0 ? devices::StampMeaning::kExposureEnd
                                                : devices::StampMeaning::kExposureStart);
    EXPECT_LT(std::abs(*frame->arrival_ns - frame->timestamp_ns), 200'000'000);
  }
}

TEST(Behaviour5, AShortJpegCostsOneFrameAndIsCounted) {
  const UvcSimulator simulator({"--short-every", "5"});
  const auto camera = Open(Options(kUsb, PixelFormat::kMjpeg, 320, 240));
  FrameLoss loss;
  for (int i = 0; i < 24; ++i) {
    const auto frame = camera->NextWithin(kLong);
    ASSERT_TRUE(frame);
    loss += frame->loss;
    // The lower half of a repaired image is uniformly grey; the ramp is not.
    EXPECT_NE(frame->grey(3, 239), frame->grey(40, 239));
  }
  EXPECT_GE(loss.damaged, 5);
  EXPECT_LE(loss.damaged, 7);
}

}  // namespace
}  // namespace pleinair::vm
