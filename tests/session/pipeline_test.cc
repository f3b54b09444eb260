#include "session/pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "devices/recordings/recording.h"
#include "tests/source_tree.h"

namespace pleinair::session {
namespace {

/// A bundled recording without a virtual object: nothing is drawn.
devices::Recording Open(const char* name) {
  auto recording = devices::OpenRecording(tests::SourceTree() / "recordings" / name);
  EXPECT_TRUE(recording) << recording.error().Message();
  recording->scene->objects.clear();
  return *std::move(recording);
}

devices::Recording OpenTag() { return Open("courtyard_tag36h11"); }

/// At most the first six frames.
std::vector<devices::Frame> FramesOf(devices::Recording recording) {
  std::vector<devices::Frame> frames;
  while (frames.size() < 6) {
    auto frame = recording.frames->Next();
    EXPECT_TRUE(frame) << frame.error().Message();
    if (!*frame) break;
    frames.push_back(**std::move(frame));
  }
  return frames;
}

bool SamePixels(const RgbImage& a, const RgbImage& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::equal(a.data(), a.data() + a.size(), b.data());
}

TEST(Pipeline, GivesPoseAndTheFrameItselfWhereThereIsNothingToDraw) {
  devices::Recording recording = OpenTag();
  auto pipeline = Pipeline::Create(recording.camera, *recording.scene);
  ASSERT_TRUE(pipeline) << pipeline.error().Message();
  for (const devices::Frame& frame : FramesOf(std::move(recording))) {
    const auto composed = (*pipeline)->Process(frame);
    ASSERT_TRUE(composed) << composed.error().Message();
    ASSERT_TRUE(composed->pose) << frame.index;
    EXPECT_EQ(composed->pose->marker, (MarkerName{"tag36h11", 0}));
    EXPECT_EQ(composed->pose->observation.frame_index, frame.index);
    EXPECT_GT(composed->pose->observation.camera_from_marker.translation_m.z, 0.0);
    EXPECT_TRUE(SamePixels(composed->image, frame.rgb));
    EXPECT_FALSE(composed->light);
  }
}

TEST(Pipeline, DrawsAtTheDepthOfAFrameAtAnySize) {
  auto recording = devices::OpenRecording(tests::SourceTree() / "recordings/courtyard_midday");
  ASSERT_TRUE(recording);
  PipelineOptions options;
  options.image_size = ImageSize{160, 120};
  options.light.overrides.max_patches = 2'000;
  devices::Frame frame = FramesOf(Open("courtyard_midday")).front();
  const auto composed = [&] {
    auto pipeline = Pipeline::Create(recording->camera, *recording->scene, options);
    EXPECT_TRUE(pipeline);
    auto drawn = (*pipeline)->Process(frame);
    EXPECT_TRUE(drawn && drawn->light);
    return drawn->image;
  };
  const RgbImage plain = composed();
  // Nearly half a step brighter, which 8 bits do not show.
  frame.deep = DeepImage(frame.rgb.width(), frame.rgb.height(), 3);
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) {
    frame.deep.data()[i] =
        static_cast<std::uint16_t>(std::min(257 * frame.rgb.data()[i] + 120, 65'535));
  }
  const RgbImage deep = composed();
  ASSERT_EQ(deep.size(), plain.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < deep.size(); ++i) sum += deep.data()[i] - plain.data()[i];
  EXPECT_NEAR(sum / static_cast<double>(deep.size()), 120.0 / 257.0, 0.15);
}

TEST(Pipeline, HasNoPoseWhereTheMarkerIsNotSeen) {
  devices::Recording recording = OpenTag();
  auto pipeline = Pipeline::Create(recording.camera, *recording.scene);
  ASSERT_TRUE(pipeline);
  std::vector<devices::Frame> frames = FramesOf(std::move(recording));
  ASSERT_TRUE((*pipeline)->Process(frames[0]));
  devices::Frame blank = frames[1];
  std::fill_n(blank.grey.data(), blank.grey.size(), std::uint8_t{128});
  std::fill_n(blank.rgb.data(), blank.rgb.size(), std::uint8_t{128});
  const auto composed = (*pipeline)->Process(blank);
  ASSERT_TRUE(composed);
  EXPECT_FALSE(composed->pose);
  EXPECT_TRUE(SamePixels(composed->image, blank.rgb));
}

TEST(Pipeline, MeasuresSeveralFramesTogetherAsOneByOne) {
  for (const auto& [name, marker] : {std::pair{"courtyard_tag36h11", MarkerName{"tag36h11", 0}},
                                     std::pair{"courtyard_midday", MarkerName{"sg", 17}}}) {
    devices::Recording recording = Open(name);
    auto one_by_one = Pipeline::Create(recording.camera, *recording.scene);
    auto together = Pipeline::Create(recording.camera, *recording.scene);
    ASSERT_TRUE(one_by_one && together);
    std::vector<FoundFrame> found;
    for (devices::Frame& frame : FramesOf(std::move(recording))) {
      ASSERT_TRUE((*one_by_one)->Track(frame));
      auto one = (*together)->Find(std::move(frame));
      ASSERT_TRUE(one);
      found.push_back(*std::move(one));
    }
    ASSERT_EQ((*together)->Measure(found).size(), 6U);
    const std::vector<Observation>& a = (*one_by_one)->tracks().TrackOf(marker);
    const std::vector<Observation>& b = (*together)->tracks().TrackOf(marker);
    ASSERT_EQ(a.size(), 6U) << name;
    ASSERT_EQ(b.size(), 6U) << name;
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].camera_from_marker.translation_m, b[i].camera_from_marker.translation_m);
      EXPECT_EQ(a[i].camera_from_marker.rotation.m, b[i].camera_from_marker.rotation.m);
    }
  }
}

TEST(Pipeline, KeepsAsManyObservationsAsItIsToldTo) {
  devices::Recording recording = OpenTag();
  PipelineOptions options;
  options.kept_observations = 2;
  auto one_by_one = Pipeline::Create(recording.camera, *recording.scene, options);
  auto together = Pipeline::Create(recording.camera, *recording.scene, options);
  ASSERT_TRUE(one_by_one && together);
  std::vector<FoundFrame> found;
  for (devices::Frame& frame : FramesOf(std::move(recording))) {
    ASSERT_TRUE((*one_by_one)->Track(frame));
    found.push_back((*together)->Find(std::move(frame)).value());
  }
  (*together)->Measure(found);
  for (const auto& pipeline : {one_by_one->get(), together->get()}) {
    const std::vector<Observation>& kept = pipeline->tracks().TrackOf({"tag36h11", 0});
    ASSERT_EQ(kept.size(), 2U);
    EXPECT_EQ(kept.back().frame_index, 5);
  }
}

TEST(Pipeline, ComposesAtTheSizeThatIsAskedFor) {
  devices::Recording recording = OpenTag();
  PipelineOptions options;
  options.image_size = ImageSize{320, 240};
  auto pipeline = Pipeline::Create(recording.camera, *recording.scene, options);
  ASSERT_TRUE(pipeline);
  EXPECT_EQ((*pipeline)->output_camera().fx, recording.camera.fx / 2);
  const auto composed = (*pipeline)->Process(FramesOf(std::move(recording))[0]);
  ASSERT_TRUE(composed);
  EXPECT_EQ(composed->image.width(), 320);
  EXPECT_EQ(composed->image.height(), 240);
  EXPECT_TRUE(composed->pose) << "markers are found at the frame's own size";
}

TEST(Pipeline, NamesTheSceneWhereItsMarkerCannotBe) {
  devices::Recording recording = OpenTag();
  scene::SceneDescription scene = *recording.scene;
  scene.marker.size_m = -1.0;
  const auto pipeline = Pipeline::Create(recording.camera, scene);
  ASSERT_FALSE(pipeline);
  EXPECT_EQ(pipeline.error().where, scene.file.string());
}

}  // namespace
}  // namespace pleinair::session
