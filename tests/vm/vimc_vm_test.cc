// Runs inside a VM with the kernel's vimc, a camera of several stages that libcamera sets up.
#include <gmock/gmock.h>

#include <algorithm>
#include <thread>

#include "devices/cameras/camera_list.h"
#include "tests/vm/camera_helpers.h"

namespace pleinair::vm {
namespace {

using devices::PixelFormat;
using testing::HasSubstr;

constexpr const char* kFirst = "libcamera:0";

TEST(Vimc, IsListedAndSendsPicturesInOrder) {
  const std::vector<devices::CameraDescription> cameras = devices::ListCameras(false).cameras;
  const auto listed = std::find_if(cameras.begin(), cameras.end(),
                                   [](const auto& camera) { return camera.driver == "libcamera"; });
  ASSERT_NE(listed, cameras.end());
  EXPECT_THAT(listed->uri, HasSubstr("vimc"));
  const auto camera = Open(Options(listed->uri, PixelFormat::kRgb24, 320, 240));
  ASSERT_NE(camera, nullptr);
  ASSERT_TRUE(camera->NextWithin(kLong));
  // Its scaler works in steps of three pixels.
  const devices::NegotiatedFormat negotiated = *camera->negotiated();
  EXPECT_EQ(negotiated.size.width, 318);
  EXPECT_THAT(negotiated.details, testing::Contains(HasSubstr("318x240")));
  std::int64_t last_ns = 0, last_index = -1;
  for (int i = 0; i < 5; ++i) {
    const auto frame = camera->NextWithin(kLong);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->rgb.width(), negotiated.size.width);
    EXPECT_GT(frame->timestamp_ns, last_ns);
    EXPECT_GT(frame->index, last_index);
    // The sensor's test image, not uniform grey.
    EXPECT_NE(frame->grey(3, 120), frame->grey(300, 120));
    last_ns = frame->timestamp_ns;
    last_index = frame->index;
  }
}

TEST(Vimc, FiftyStartsAndStopsLeaveNothingBehind) {
  for (int round = 0; round < 50; ++round) {
    const auto camera = Open(Options(kFirst, PixelFormat::kRgb24, 320, 240));
    ASSERT_NE(camera, nullptr);
    if (round % 10 == 0) {
      EXPECT_TRUE(camera->NextWithin(kLong));
    }
    std::thread stopper([&] { camera->Stop(); });
    stopper.join();
  }
  const auto again = Open(Options(kFirst, PixelFormat::kRgb24, 320, 240));
  EXPECT_TRUE(again->NextWithin(kLong)) << "a camera left acquired would be busy";
}

}  // namespace
}  // namespace pleinair::vm
