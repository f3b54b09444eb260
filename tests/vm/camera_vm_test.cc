// Runs inside the VM, on the kernel's own drivers: docs/cameras.md lists the behaviours.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "devices/camera_list.h"
#include "devices/frame_pack.h"
#include "devices/live_camera.h"
#include "devices/recording.h"
#include "tracker/tracker.h"
#include "uvc_simulator.h"

namespace pleinair::vm {
namespace {

using devices::CameraControl;
using devices::CameraEvent;
using devices::Frame;
using devices::FrameLoss;
using devices::LiveCamera;
using devices::LiveCameraOptions;
using devices::PixelFormat;
using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::Not;
using Clock = std::chrono::steady_clock;
using Kind = CameraEvent::Kind;

constexpr milliseconds kLong{20000};  // Only ever waited out by a failing test.
constexpr const char* kUsb = "v4l2:serial=0001";

std::int64_t Now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
      .count();
}

/// The node of vivid, which is there from the start.
std::string VividNode() {
  for (const devices::CameraDescription& camera : devices::ListCameras(false).cameras) {
    if (camera.driver == "vivid") return camera.node;
  }
  return "";
}

LiveCameraOptions Options(const std::string& uri, PixelFormat format, int width, int height,
                          double rate_hz = 30.0) {
  LiveCameraOptions options;
  options.uri = *devices::ParseCameraUri(uri);
  options.pictures = {format, devices::PictureSize{width, height}, rate_hz};
  return options;
}

std::unique_ptr<LiveCamera> Open(const LiveCameraOptions& options) {
  auto camera = LiveCamera::Open(options);
  return camera ? *std::move(camera) : nullptr;
}

/// Sets a control of vivid's by its name, through a file of our own: it is the test, not the
/// camera, that wants it.
void SetByName(const std::string& node, const char* name, int value) {
  const int fd = open(node.substr(5).c_str(), O_RDWR);
  ASSERT_GE(fd, 0);
  v4l2_queryctrl query{};
  query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  bool found = false;
  while (ioctl(fd, VIDIOC_QUERYCTRL, &query) == 0) {
    if (std::strcmp(reinterpret_cast<const char*>(query.name), name) == 0) {
      v4l2_control control{};
      control.id = query.id;
      control.value = value;
      found = ioctl(fd, VIDIOC_S_CTRL, &control) == 0;
      break;
    }
    query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  close(fd);
  ASSERT_TRUE(found) << name;
}

/// Takes frames, as an application does, until an event of this kind comes; gives it.
std::optional<CameraEvent> WaitFor(LiveCamera* camera, Kind kind) {
  for (const auto end = Clock::now() + kLong; Clock::now() < end;) {
    for (const CameraEvent& event : camera->TakeEvents()) {
      if (event.kind == kind) return event;
    }
    camera->NextWithin(milliseconds(10));
  }
  return std::nullopt;
}

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
  // A driver with four buffers alone would give a frame that is a second old.
  EXPECT_LT(before - frame->timestamp_ns, 2 * 33'400'000);
  // 29 at 30 Hz; the VM of a busy machine makes fewer.
  EXPECT_GE(frame->lost_before, 20);
  EXPECT_LE(frame->lost_before, 31);
  EXPECT_LE(frame->loss.by_number, 3) << "the driver ran out of buffers";
}

FrameLoss Collect(LiveCamera* camera, int frames) {
  FrameLoss loss;
  for (int i = 0; i < frames; ++i) {
    const auto frame = camera->NextWithin(kLong);
    if (!frame) break;
    loss += frame->loss;
  }
  return loss;
}

void SetNoDrop(int value) { std::ofstream("/sys/module/uvcvideo/parameters/nodrop") << value; }

TEST(Behaviour2, DamagedFramesThatTheDriverDropsShowAsAGapInItsNumbers) {
  SetNoDrop(0);
  const UvcSimulator simulator({"--err-every", "5"});
  const auto camera = Open(Options(kUsb, PixelFormat::kYuyv, 320, 240));
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
  const UvcSimulator simulator({"--drop-every", "5"});
  const auto camera = Open(Options(kUsb, PixelFormat::kYuyv, 320, 240, 15.0));
  const FrameLoss loss = Collect(camera.get(), 40);
  // Ten are missing; the first few before the period is known, and a busy machine's VM stutters.
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
  const auto answers = camera->Answers();
  ASSERT_EQ(answers.size(), 4U);
  for (const devices::ControlAnswer& answer : answers) {
    EXPECT_TRUE(answer.held) << NameOf(answer.control);
    EXPECT_EQ(answer.words, "") << NameOf(answer.control);
  }
  EXPECT_NEAR(*answers[0].value, 0.01, 1e-9);
  EXPECT_NEAR(*answers[2].value, 5000.0, 1e-9);
  EXPECT_NEAR(frame->exposure_s.value_or(0.0), 0.01, 1e-9);
  EXPECT_NEAR(frame->gain.value_or(0.0), 80.0, 1e-9);
  EXPECT_NEAR(frame->white_balance_k.value_or(0.0), 5000.0, 1e-9);
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
  ASSERT_EQ(camera->Answers().size(), 1U);
  EXPECT_THAT(camera->Answers()[0].words, HasSubstr("no control of its focus"));
}

TEST(Behaviour5, AShortJpegCostsOneFrameAndIsCounted) {
  const UvcSimulator simulator({"--short-every", "5"});
  const auto camera = Open(Options(kUsb, PixelFormat::kMjpeg, 320, 240));
  FrameLoss loss;
  for (int i = 0; i < 24; ++i) {
    const auto frame = camera->NextWithin(kLong);
    ASSERT_TRUE(frame);
    loss += frame->loss;
    // The lower half of a mended picture is of one grey; the ramp is not.
    EXPECT_NE(frame->grey(3, 239), frame->grey(40, 239));
  }
  EXPECT_GE(loss.damaged, 5);
  EXPECT_LE(loss.damaged, 7);
}

TEST(Behaviour6And7, AnUnpluggedCameraIsToldWithinASecondAndComesBackByItself) {
  UvcSimulator simulator({"--unplug-after", "10", "--replug-ms", "1500"});
  LiveCameraOptions options = Options(kUsb, PixelFormat::kYuyv, 320, 240);
  options.controls = {{CameraControl::kExposure, 0.02}};
  const auto camera = Open(options);
  ASSERT_TRUE(WaitFor(camera.get(), Kind::kConnected));
  std::int64_t last_frame_ns = Now_ns();
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(camera->NextWithin(kLong));
    last_frame_ns = Now_ns();
  }
  const auto gone = WaitFor(camera.get(), Kind::kGone);
  ASSERT_TRUE(gone);
  EXPECT_LT(gone->time_ns - last_frame_ns, 1'000'000'000);
  ASSERT_TRUE(WaitFor(camera.get(), Kind::kConnected)) << simulator.Output();
  ASSERT_TRUE(camera->NextWithin(kLong));
  EXPECT_EQ(camera->counts().connections, 2);
  ASSERT_EQ(camera->Answers().size(), 1U);
  EXPECT_TRUE(camera->Answers()[0].held) << "controls are held again after the replug";
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

TEST(Behaviour9, EveryFormatOfVividConvertsRightOrIsRefusedByName) {
  const std::string node = VividNode();
  SetByName(node, "Test Pattern", 0);   // 75 % colour bars.
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
    EXPECT_EQ((*camera)->agreement()->format, *format.format);
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
  // Were a file left open with buffers, the next one would be told that the camera is busy.
  LiveCameraOptions options = Options(node, PixelFormat::kYuyv, 320, 180);
  options.wait_for_camera = false;
  EXPECT_TRUE(LiveCamera::Open(options));
}

/// What a grey picture looks like after it went through the camera's Y of limited range.
GreyImage ThroughYuyv(const GreyImage& grey) {
  devices::RawPicture raw;
  raw.format = PixelFormat::kYuyv;
  raw.width = grey.width();
  raw.height = grey.height();
  raw.stride = static_cast<std::size_t>(grey.width()) * 2;
  for (std::size_t i = 0; i < grey.size(); ++i) {
    raw.bytes.push_back(grey.data()[i]);
    raw.bytes.push_back(128);
  }
  devices::Picture picture;
  EXPECT_TRUE(ConvertRawPicture(raw, &picture));
  return picture.grey;
}

bool Same(const GreyImage& a, const GreyImage& b) {
  return a.size() == b.size() && std::equal(a.data(), a.data() + a.size(), b.data());
}

/// The camera's place in the marker's frame, from lines of "seconds x y z qx qy qz qw".
std::vector<Vec3> TruePlaces() {
  std::ifstream file(PLEINAIR_SOURCE_DIR "/recordings/courtyard_tag36h11/truth.tum");
  std::vector<Vec3> places;
  for (std::string line; std::getline(file, line);) {
    std::istringstream numbers(line);
    double seconds = 0.0;
    Vec3 place;
    if (numbers >> seconds >> place.x >> place.y >> place.z) places.push_back(place);
  }
  return places;
}

TEST(Behaviour12, WhatIsRecordedLiveReplaysToIdenticalPosesAndTheseAreRight) {
  constexpr int kFrames = 6;
  auto recording = devices::OpenRecording(PLEINAIR_SOURCE_DIR "/recordings/courtyard_tag36h11");
  ASSERT_TRUE(recording);
  std::vector<GreyImage> sent;
  std::ofstream bytes("/tmp/sequence.grey", std::ios::binary);
  for (int i = 0; i < kFrames; ++i) {
    const auto frame = recording->frames->Next();
    ASSERT_TRUE(frame && *frame);
    const GreyImage& grey = (*frame)->grey;
    bytes.write(reinterpret_cast<const char*>(grey.data()),
                static_cast<std::streamsize>(grey.size()));
    sent.push_back(ThroughYuyv(grey));
  }
  bytes.close();
  tracker::TrackerOptions options;
  options.families = {"tag36h11"};  // Quick to find, even in a machine made of software.
  options.marker_size_m = recording->scene->marker.size_m;
  const auto tracker = tracker::Tracker::Create(recording->camera, options);
  ASSERT_TRUE(tracker);

  const UvcSimulator simulator({"--fps", "5", "--grey", "/tmp/sequence.grey", "640", "480"});
  const auto camera = Open(Options(kUsb, PixelFormat::kYuyv, 640, 480));
  const auto writer = devices::FramePackWriter::Create("/tmp/live.pack");
  ASSERT_TRUE(writer);
  std::vector<Frame> live;
  std::vector<std::size_t> numbers;
  std::vector<Transform<Camera, Marker>> poses;
  for (int i = 0; i < 4; ++i) {
    auto frame = camera->NextWithin(kLong);
    ASSERT_TRUE(frame);
    ASSERT_TRUE((*writer)->Add(*frame));
    const auto which = std::find_if(sent.begin(), sent.end(),
                                    [&](const GreyImage& each) { return Same(each, frame->grey); });
    ASSERT_NE(which, sent.end()) << "frame " << i << " is none of those that were sent";
    numbers.push_back(static_cast<std::size_t>(which - sent.begin()));
    const auto sightings = (*tracker)->Track(frame->grey.view());
    ASSERT_TRUE(sightings);
    ASSERT_EQ(sightings->size(), 1U);
    poses.push_back(sightings->front().pose.best.camera_from_marker);
    live.push_back(std::move(*frame));
  }
  const std::vector<Vec3> truth = TruePlaces();
  const auto replayed = devices::OpenFramePack("/tmp/live.pack", {640, 480});
  ASSERT_TRUE(replayed);
  for (std::size_t i = 0; i < live.size(); ++i) {
    const Vec3 place = poses[i].Inverse().translation_m;
    const Vec3 error = place - truth[numbers[i]];
    std::cout << "place wrong by " << Norm(error) * 1000.0 << " mm\n";
    EXPECT_LT(Norm(error), 0.02);
    const auto frame = replayed->frames->Next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ((*frame)->timestamp_ns, live[i].timestamp_ns - live[0].timestamp_ns);
    EXPECT_EQ((*frame)->exposure_s, live[i].exposure_s);
    const auto sightings = (*tracker)->Track((*frame)->grey.view());
    ASSERT_TRUE(sightings);
    ASSERT_EQ(sightings->size(), 1U);
    const auto& again = sightings->front().pose.best.camera_from_marker;
    EXPECT_EQ(Norm(again.translation_m - poses[i].translation_m), 0.0);
    EXPECT_EQ(again.rotation.m, poses[i].rotation.m);
  }
}

// Last: vivid's node does not come back.
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
