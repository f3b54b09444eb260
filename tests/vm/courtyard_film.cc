#include "tests/vm/courtyard_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>

#include "devices/recordings/frame_pack.h"
#include "devices/recordings/recording.h"
#include "tests/source_tree.h"
#include "tests/vm/camera_helpers.h"
#include "tracker/tracker.h"

namespace pleinair::vm {
namespace {

using devices::Frame;

const std::string kRecording = tests::SourceTree() / "recordings/courtyard_tag36h11";
constexpr int kPictures = 6;
constexpr int kTracked = 4;

bool Same(const GreyImage& a, const GreyImage& b) {
  return a.size() == b.size() && std::equal(a.data(), a.data() + a.size(), b.data());
}

/// Camera positions in the marker's frame, from lines of "seconds x y z qx qy qz qw".
std::vector<Vec3> TruePlaces() {
  std::ifstream file(std::string(kRecording) + "/truth.tum");
  std::vector<Vec3> places;
  for (std::string line; std::getline(file, line);) {
    std::istringstream numbers(line);
    double seconds = 0.0;
    Vec3 place;
    if (numbers >> seconds >> place.x >> place.y >> place.z) places.push_back(place);
  }
  return places;
}

}  // namespace

CourtyardFilm OpenCourtyardFilm() {
  CourtyardFilm film;
  auto recording = devices::OpenRecording(kRecording);
  EXPECT_TRUE(recording);
  if (!recording) return film;
  film.camera = recording->camera;
  film.marker_size_m = recording->scene->marker.size_m;
  film.places = TruePlaces();
  for (int i = 0; i < kPictures; ++i) {
    const auto frame = recording->frames->Next();
    EXPECT_TRUE(frame && *frame);
    if (!frame || !*frame) break;
    film.pictures.push_back((*frame)->grey);
  }
  return film;
}

std::size_t NumberOf(const GreyImage& grey, const std::vector<GreyImage>& pictures) {
  return static_cast<std::size_t>(
      std::find_if(pictures.begin(), pictures.end(),
                   [&](const GreyImage& each) { return Same(each, grey); }) -
      pictures.begin());
}

void ExpectRightPosesAndTheSameInReplay(devices::LiveCamera* camera, const CourtyardFilm& film,
                                        const std::vector<GreyImage>& sent) {
  const std::string pack = testing::TempDir() + "live.pack";
  std::remove(pack.c_str());
  tracker::TrackerOptions options;
  options.families = {"tag36h11"};  // Fast to detect, even in a software-emulated machine.
  options.marker_size_m = film.marker_size_m;
  const auto tracker = tracker::Tracker::Create(film.camera, options);
  ASSERT_TRUE(tracker);
  const auto writer = devices::FramePackWriter::Create(pack);
  ASSERT_TRUE(writer);
  std::vector<Frame> live;
  std::vector<std::size_t> numbers;
  std::vector<Transform<Camera, Marker>> poses;
  for (int i = 0; i < kTracked; ++i) {
    auto frame = camera->NextWithin(kLong);
    ASSERT_TRUE(frame);
    ASSERT_TRUE((*writer)->Add(*frame));
    numbers.push_back(NumberOf(frame->grey, sent));
    ASSERT_LT(numbers.back(), sent.size()) << "frame " << i << " is none of those that were sent";
    const auto observations = (*tracker)->Track(frame->grey.view());
    ASSERT_TRUE(observations);
    ASSERT_EQ(observations->size(), 1U);
    poses.push_back(observations->front().pose.best.camera_from_marker);
    live.push_back(std::move(*frame));
  }
  const auto replayed = devices::OpenFramePack(pack, {film.camera.width, film.camera.height});
  ASSERT_TRUE(replayed);
  for (std::size_t i = 0; i < live.size(); ++i) {
    const Vec3 error = poses[i].Inverse().translation_m - film.places[numbers[i]];
    std::cout << "place wrong by " << Norm(error) * 1000.0 << " mm\n";
    EXPECT_LT(Norm(error), 0.005);
    const auto frame = replayed->frames->Next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ((*frame)->timestamp_ns, live[i].timestamp_ns - live[0].timestamp_ns);
    EXPECT_EQ((*frame)->settings.exposure_s, live[i].settings.exposure_s);
    const auto observations = (*tracker)->Track((*frame)->grey.view());
    ASSERT_TRUE(observations);
    ASSERT_EQ(observations->size(), 1U);
    const auto& again = observations->front().pose.best.camera_from_marker;
    EXPECT_EQ(Norm(again.translation_m - poses[i].translation_m), 0.0);
    EXPECT_EQ(again.rotation.m, poses[i].rotation.m);
  }
  std::remove(pack.c_str());
}

}  // namespace pleinair::vm
