// Runs inside the VM, on the kernel's own drivers: docs/measurements/capture.md lists the
// behaviours.
#include <gmock/gmock.h>

#include <cmath>
#include <iostream>
#include <map>
#include <thread>

#include "devices/cameras/camera_list.h"
#include "tests/vm/camera_helpers.h"

namespace pleinair::vm {
namespace {

using devices::LiveCamera;
using devices::LiveCameraOptions;
using devices::PixelFormat;
using testing::HasSubstr;

TEST(Behaviour9, EveryFormatOfVividConvertsRightOrIsRefusedByName) {
  const std::string node = VividNode();
  SetByName(node, "Test Pattern", 0);   // 75 % color bars.
  SetByName(node, "OSD Text Mode", 2);  // No text in them.
  devices::CameraDescription vivid;
  for (const devices::CameraDescription& camera : devices::ListCameras(false).cameras) {
    if (camera.driver == "vivid") vivid = camera;
  }
  // White, yellow, cyan, green, magenta, red, blue, black.
  constexpr int kBars[8][3] = {{191, 191, 191}, {191, 191, 0}, {0, 191, 191}, {0, 191, 0},
                               {191, 0, 191},   {191, 0, 0},   {0, 0, 191},   {0, 0, 0}};
  std::map<PixelFormat, int> seen;
  int refused = 0;
  for (const devices::FormatDescription& format : vivid.formats) {
    if (!format.format) {
      ++refused;
      continue;
    }
    ++seen[*format.format];
    LiveCameraOptions options = Options(node, *format.format, 320, 180);
    options.wait_for_camera = false;
    auto camera = LiveCamera::Open(options);
    ASSERT_TRUE(camera) << format.name << ": " << camera.error().Message();
    const auto frame = (*camera)->NextWithin(kLong);
    ASSERT_TRUE(frame) << format.name;
    EXPECT_EQ((*camera)->negotiated()->format, *format.format);
    for (int bar = 0; bar < 8; ++bar) {
      const int x = bar * 40 + 20, y = 90;
      int expected[3] = {kBars[bar][0], kBars[bar][1], kBars[bar][2]};
      if (*format.format == PixelFormat::kGrey8) {
        // vivid weighs by Rec. ITU-R BT.709.
        const double luma = 0.2126 * expected[0] + 0.7152 * expected[1] + 0.0722 * expected[2];
        expected[0] = expected[1] = expected[2] = static_cast<int>(std::lround(luma));
      }
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(frame->rgb(x, y, c), expected[c], 4)
            << format.name << ", bar " << bar << ", channel " << c;
      }
    }
  }
  std::cout << seen.size() << " formats read, " << refused << " not\n";
  EXPECT_GE(seen.size(), 12U);
  LiveCameraOptions options = Options(node, PixelFormat::kMjpeg, 320, 180);
  options.wait_for_camera = false;
  const auto camera = LiveCamera::Open(options);
  ASSERT_FALSE(camera);
  EXPECT_THAT(camera.error().what, HasSubstr("does not send MJPG but YUYV"));
}

TEST(Behaviour9, ABusyCameraIsToldInWords) {
  const auto first = Open(Options(VividNode(), PixelFormat::kYuyv, 320, 180));
  ASSERT_TRUE(first->NextWithin(kLong));
  LiveCameraOptions options = Options(VividNode(), PixelFormat::kYuyv, 320, 180);
  options.wait_for_camera = false;
  const auto second = LiveCamera::Open(options);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().Message(), HasSubstr("another program uses the camera"));
}

TEST(Behaviour11, FiftyStartsAndStopsLeaveNothingBehind) {
  const std::string node = VividNode();
  for (int round = 0; round < 50; ++round) {
    const auto camera = Open(Options(node, PixelFormat::kYuyv, 320, 180));
    ASSERT_NE(camera, nullptr);
    if (round % 10 == 0) {
      EXPECT_TRUE(camera->NextWithin(kLong));
    }
    std::thread stopper([&] { camera->Stop(); });
    stopper.join();
  }
  // If a file with buffers were still open, the next open would report a busy camera.
  LiveCameraOptions options = Options(node, PixelFormat::kYuyv, 320, 180);
  options.wait_for_camera = false;
  EXPECT_TRUE(LiveCamera::Open(options));
}

}  // namespace
}  // namespace pleinair::vm
