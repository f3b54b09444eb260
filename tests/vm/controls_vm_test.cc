// Runs inside the VM, on the kernel's own drivers: docs/measurements/capture.md lists the
// behaviours.
#include <gmock/gmock.h>

#include <optional>

#include "tests/vm/camera_helpers.h"
#include "tests/vm/uvc_simulator.h"

namespace pleinair::vm {
namespace {

using devices::CameraControl;
using devices::Frame;
using devices::LiveCameraOptions;
using devices::PixelFormat;
using testing::HasSubstr;

TEST(Behaviour4, ControlsAreHeldOneByOneReadBackAndReachTheCamera) {
  UvcSimulator simulator;
  LiveCameraOptions options = Options(kUsb, PixelFormat::kYuyv, 320, 240);
  options.controls = {{CameraControl::kExposure, 0.01},
                      {CameraControl::kGain, 80.0},
                      {CameraControl::kWhiteBalance, 5000.0},
                      {CameraControl::kFocus, 50.0}};
  const auto camera = Open(options);
  const auto frame = [&] {
    std::optional<Frame> last;
    for (int i = 0; i < 5; ++i) last = camera->NextWithin(kLong);
    return last;
  }();
  ASSERT_TRUE(frame);
  const auto results = camera->ControlResults();
  ASSERT_EQ(results.size(), 4U);
  for (const devices::ControlResult& result : results) {
    EXPECT_TRUE(result.locked) << NameOf(result.control);
    EXPECT_EQ(result.details, "") << NameOf(result.control);
  }
  EXPECT_NEAR(*results[0].value, 0.01, 1e-9);
  EXPECT_NEAR(*results[2].value, 5000.0, 1e-9);
  EXPECT_NEAR(frame->settings.exposure_s.value_or(0.0), 0.01, 1e-9);
  EXPECT_NEAR(frame->settings.gain.value_or(0.0), 80.0, 1e-9);
  EXPECT_NEAR(frame->settings.white_balance_k.value_or(0.0), 5000.0, 1e-9);
  const std::string sent = simulator.Output();
  for (const char* line : {"ctrl 1 0x02 1", "ctrl 1 0x04 100", "ctrl 2 0x04 80", "ctrl 2 0x0b 0",
                           "ctrl 2 0x0a 5000", "ctrl 1 0x08 0", "ctrl 1 0x06 50"}) {
    EXPECT_THAT(sent, HasSubstr(line));
  }
  EXPECT_LT(sent.find("ctrl 1 0x02 1"), sent.find("ctrl 1 0x04 100")) << "automatism off first";
}

TEST(Behaviour4, WhatADeviceLacksIsSaid) {
  LiveCameraOptions options = Options(VividNode(), PixelFormat::kYuyv, 320, 180);
  options.controls = {{CameraControl::kFocus, 50.0}};
  const auto camera = Open(options);
  ASSERT_TRUE(camera->NextWithin(kLong));
  ASSERT_EQ(camera->ControlResults().size(), 1U);
  EXPECT_THAT(camera->ControlResults()[0].details, HasSubstr("no control of its focus"));
}

}  // namespace
}  // namespace pleinair::vm
