// Runs inside the VM, on the kernel's own drivers: docs/cameras.md lists the behaviours.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>

#include "camera_helpers.h"
#include "devices/frame_pack.h"
#include "devices/recording.h"
#include "tracker/tracker.h"
#include "uvc_simulator.h"

namespace pleinair::vm {
namespace {

using devices::Frame;
using devices::PixelFormat;

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

/// By the way to the camera.
class Behaviour12 : public testing::TestWithParam<const char*> {};

TEST_P(Behaviour12, WhatIsRecordedLiveReplaysToIdenticalPosesAndTheseAreRight) {
  std::remove("/tmp/live.pack");
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
  const auto camera = Open(Options(GetParam(), PixelFormat::kYuyv, 640, 480));
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
    EXPECT_LT(Norm(error), 0.005);
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

INSTANTIATE_TEST_SUITE_P(V4l2, Behaviour12, testing::Values(kUsb));
#ifdef PLEINAIR_HAS_LIBCAMERA
INSTANTIATE_TEST_SUITE_P(Libcamera, Behaviour12, testing::Values("libcamera:0"));
#endif

}  // namespace
}  // namespace pleinair::vm
