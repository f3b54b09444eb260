#include "devices/cameras/camera_uri.h"

#include <gmock/gmock.h>

namespace pleinair::devices {
namespace {

using testing::HasSubstr;

TEST(CameraUri, ReadsEveryKindAndWritesItAsItWas) {
  for (const char* text : {"v4l2:/dev/video0", "v4l2:serial=ABC 12", "v4l2:bus=usb-0000:00:14.0-1",
                           "libcamera:\\_SB_.VUSB-1:1.0-1d6b:0105", "aravis:Aravis-Fake-GV01",
                           "file:/home/me/site recording"}) {
    const auto uri = ParseCameraUri(text);
    ASSERT_TRUE(uri) << text;
    EXPECT_EQ(uri->ToString(), text);
  }
  EXPECT_EQ(ParseCameraUri("v4l2:serial=7")->key, CameraUri::Key::kSerial);
}

TEST(CameraUri, RefusesOthersAndSaysWhatToWrite) {
  for (const char* text :
       {"", "v4l2", "v4l2:", "v4l2:video0", "v4l2:serial=", "usb:1", "aravis:"}) {
    const auto uri = ParseCameraUri(text);
    ASSERT_FALSE(uri) << text;
    EXPECT_THAT(uri.error().remedy, HasSubstr("v4l2:/dev/video0"));
  }
}

}  // namespace
}  // namespace pleinair::devices
