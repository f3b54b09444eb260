#include "devices/cameras/v4l2/v4l2_device.h"

#include <gmock/gmock.h>

#include <string>

#include "devices/cameras/v4l2/v4l2_node.h"
#include "tests/devices/cameras/v4l2/fake_v4l2.h"

namespace pleinair::devices {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const CameraUri kNode{CameraUri::Backend::kV4l2, CameraUri::Key::kNode, "/dev/video0"};

Result<std::unique_ptr<CameraDevice>> Open(const std::shared_ptr<FakeV4l2>& io,
                                           const CameraUri& uri = kNode,
                                           const FormatRequest& requested = {}) {
  return OpenV4l2Device(io, uri, requested);
}

std::string Set(__u32 id, int value) { return std::to_string(id) + "=" + std::to_string(value); }

TEST(V4l2Device, DeliversWhatTheDriverSaysOfAPicture) {
  const auto io = std::make_shared<FakeV4l2>();
  const auto device = Open(io);
  ASSERT_TRUE(device) << device.error().Message();
  EXPECT_TRUE(io->streaming);
  io->next.sequence = 41;
  CapturedImage image;
  ASSERT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kImage);
  EXPECT_EQ(image.number, 41);
  EXPECT_EQ(image.timestamp_ns, 12'345'678'000);
  EXPECT_EQ(image.stamp_meaning, StampMeaning::kExposureStart);
  EXPECT_EQ(image.raw.bytes.size(), 64U);
  EXPECT_EQ(image.raw.format, PixelFormat::kYuyv);
  EXPECT_FALSE(image.damaged);
  io->next.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_ERROR;
  ASSERT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kImage);
  EXPECT_EQ(image.stamp_meaning, StampMeaning::kExposureEnd);
  EXPECT_TRUE(image.damaged);
}

TEST(V4l2Device, TakesArrivalWhereTheDriversClockIsAnother) {
  const auto io = std::make_shared<FakeV4l2>();
  const auto device = Open(io);
  io->next.flags = V4L2_BUF_FLAG_TIMESTAMP_COPY;
  CapturedImage image;
  ASSERT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kImage);
  EXPECT_EQ(image.stamp_meaning, StampMeaning::kArrival);
  EXPECT_EQ(image.timestamp_ns, image.arrival_ns);
  EXPECT_EQ(image.device_timestamp_ns, 12'345'678'000);
}

TEST(V4l2Device, CountsOnWhenTheDriversNumberWrapsRound) {
  const auto io = std::make_shared<FakeV4l2>();
  const auto device = Open(io);
  CapturedImage image;
  io->next.sequence = 0xFFFFFFFF;
  ASSERT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kImage);
  io->next.sequence = 1;
  ASSERT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kImage);
  EXPECT_EQ(image.number, 0x100000001);
}

TEST(V4l2Device, IsGoneAlikeForEveryWayInWhichDriversSayIt) {
  for (const int error : {EINVAL, EIO, ENODEV}) {
    const auto io = std::make_shared<FakeV4l2>();
    const auto device = Open(io);
    io->failing[VIDIOC_DQBUF] = error;
    CapturedImage image;
    EXPECT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kGone) << error;
    EXPECT_THAT((*device)->StatusMessage(), HasSubstr("the stream ended"));
  }
  const auto io = std::make_shared<FakeV4l2>();
  const auto device = Open(io);
  io->poll_events = POLLHUP;
  io->failing[VIDIOC_DQBUF] = EAGAIN;
  CapturedImage image;
  EXPECT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kGone);
}

TEST(V4l2Device, GivesEverythingBackAtItsEnd) {
  const auto io = std::make_shared<FakeV4l2>();
  {
    const auto device = Open(io);
    ASSERT_TRUE(device);
    EXPECT_GT(io->maps, 0);
  }
  EXPECT_EQ(io->maps, 0);
  EXPECT_THAT(io->open_fds, IsEmpty());
  EXPECT_FALSE(io->streaming);
}

TEST(V4l2Device, GivesEverythingBackWhereItCannotStart) {
  for (const unsigned long request : {VIDIOC_REQBUFS, VIDIOC_QUERYBUF, VIDIOC_QBUF, VIDIOC_STREAMON,
                                      VIDIOC_S_FMT, VIDIOC_G_FMT, VIDIOC_QUERYCAP}) {
    const auto io = std::make_shared<FakeV4l2>();
    io->failing[request] = ENOSPC;
    EXPECT_FALSE(Open(io)) << request;
    EXPECT_EQ(io->maps, 0);
    EXPECT_THAT(io->open_fds, IsEmpty());
  }
}

TEST(V4l2Device, SaysInWordsWhatADriverMeans) {
  const auto details = [](unsigned long request, int error) {
    const auto io = std::make_shared<FakeV4l2>();
    io->failing[request] = error;
    return Open(io).error().Message();
  };
  EXPECT_THAT(details(VIDIOC_STREAMON, ENOSPC), HasSubstr("too little bandwidth"));
  EXPECT_THAT(details(VIDIOC_S_FMT, EBUSY), HasSubstr("another program"));
  const auto io = std::make_shared<FakeV4l2>();
  io->nodes["/dev/video0"].open_error = EACCES;
  EXPECT_THAT(Open(io).error().Message(), HasSubstr("no permission"));
}

TEST(V4l2Device, TellsEachDifferenceBetweenAskedAndGot) {
  const auto io = std::make_shared<FakeV4l2>();
  FormatRequest requested;
  requested.size = ImageSize{640, 480};
  requested.rate_hz = 60.0;
  const auto device = Open(io, kNode, requested);
  ASSERT_TRUE(device);
  EXPECT_THAT((*device)->negotiated().details,
              ElementsAre("requested 640x480, got 8x4", "requested 60 Hz, got 30 Hz"));
}

TEST(V4l2Device, RefusesAFormatThatTheCameraHasNotByName) {
  const auto io = std::make_shared<FakeV4l2>();
  FormatRequest requested;
  requested.format = PixelFormat::kNv12;
  EXPECT_EQ(Open(io, kNode, requested).error().what, "does not send NV12 but YUYV, MJPG");
  io->formats = {V4L2_PIX_FMT_Y16};
  EXPECT_THAT(Open(io).error().what, HasSubstr("no supported format, but Y16"));
}

TEST(V4l2Device, TakesTheDriversWordOnColours) {
  const auto io = std::make_shared<FakeV4l2>();
  io->pixels.colorspace = V4L2_COLORSPACE_REC709;
  auto device = Open(io);
  CapturedImage image;
  ASSERT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kImage);
  EXPECT_EQ(image.raw.matrix, YuvMatrix::kBt709);
  EXPECT_FALSE(image.raw.full_range);
  io->pixels.quantization = V4L2_QUANTIZATION_FULL_RANGE;
  io->pixels.ycbcr_enc = V4L2_YCBCR_ENC_601;
  device = Open(io);
  ASSERT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kImage);
  EXPECT_EQ(image.raw.matrix, YuvMatrix::kBt601);
  EXPECT_TRUE(image.raw.full_range);
}

TEST(V4l2Node, IsFoundBySerialPastTheMetadataNode) {
  const auto io = std::make_shared<FakeV4l2>();
  io->nodes = {{"/dev/video0", {"other"}},
               {"/dev/video1", {"0001", "usb-1", V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING}},
               {"/dev/video2", {"0001"}}};
  const auto node = FindV4l2Node(io, {CameraUri::Backend::kV4l2, CameraUri::Key::kSerial, "0001"});
  ASSERT_TRUE(node);
  EXPECT_EQ(node->path, "/dev/video2");
  EXPECT_FALSE(FindV4l2Node(io, {CameraUri::Backend::kV4l2, CameraUri::Key::kSerial, "2"}));
}

TEST(V4l2Node, GoesByItsPlaceWhereAnotherHasTheSameSerial) {
  const auto io = std::make_shared<FakeV4l2>();
  io->nodes = {{"/dev/video0", {"0001", "usb-1"}}, {"/dev/video2", {"0001", "usb-2"}}};
  const auto device = Open(io, {CameraUri::Backend::kV4l2, CameraUri::Key::kNode, "/dev/video2"});
  ASSERT_TRUE(device);
  EXPECT_EQ((*device)->identity().ToString(), "v4l2:bus=usb-2");
  io->nodes.erase("/dev/video0");
  EXPECT_EQ((*Open(io, {CameraUri::Backend::kV4l2, CameraUri::Key::kNode, "/dev/video2"}))
                ->identity()
                .ToString(),
            "v4l2:serial=0001");
}

TEST(V4l2Node, ListsCamerasOnlyAndSaysWhatKeepsOneFromUse) {
  const auto io = std::make_shared<FakeV4l2>();
  io->nodes = {{"/dev/video0", {"0001"}},
               {"/dev/video1", {"0001", "usb-1", V4L2_CAP_META_CAPTURE}},
               {"/dev/video2", {"", "usb-2", 0, EACCES}}};
  const auto cameras = ListV4l2Cameras(io);
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].uri, "v4l2:serial=0001");
  ASSERT_EQ(cameras[0].formats.size(), 2U);
  EXPECT_EQ(cameras[0].formats[0].sizes.at(0).rates_hz, std::vector<double>{30.0});
  EXPECT_THAT(cameras[1].trouble, HasSubstr("no permission"));
  EXPECT_THAT(io->open_fds, IsEmpty());
}

TEST(V4l2Controls, AreHeldByTurningTheAutomatismOffFirst) {
  const auto io = std::make_shared<FakeV4l2>();
  io->controls = {{V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY},
                  {V4L2_CID_EXPOSURE_ABSOLUTE, 250},
                  {V4L2_CID_GAIN, 64}};
  const auto device = Open(io);
  const auto results = (*device)->LockControls(
      {{CameraControl::kExposure, 0.01}, {CameraControl::kGain, {}}, {CameraControl::kFocus, 3.0}});
  EXPECT_THAT(io->calls, ElementsAre(Set(V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL),
                                     Set(V4L2_CID_EXPOSURE_ABSOLUTE, 100), Set(V4L2_CID_GAIN, 64)));
  ASSERT_EQ(results.size(), 3U);
  EXPECT_NEAR(*results[0].value, 0.01, 1e-9);
  EXPECT_TRUE(results[0].locked);
  EXPECT_TRUE(results[1].locked);
  EXPECT_FALSE(results[2].locked);
  EXPECT_EQ(results[2].details, "the camera has no control of its focus");
  CapturedImage image;
  ASSERT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kImage);
  EXPECT_NEAR(*image.settings.exposure_s, 0.01, 1e-9);
}

TEST(V4l2Controls, SayNothingOfAnExposureThatChangesByItself) {
  const auto io = std::make_shared<FakeV4l2>();
  io->controls = {{V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY},
                  {V4L2_CID_EXPOSURE_ABSOLUTE, 250},
                  {V4L2_CID_GAIN, 64}};
  const auto device = Open(io);
  CapturedImage image;
  ASSERT_EQ((*device)->Wait(milliseconds(1), &image), WaitOutcome::kImage);
  EXPECT_FALSE(image.settings.exposure_s);
  EXPECT_FALSE(image.settings.gain);
}

}  // namespace
}  // namespace pleinair::devices
