// Measures the memory that tracking allocates, by counting operator new.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/tracker/counted_memory.h"
#include "tests/tracker/surf_golay/sg_test_scenes.h"
#include "tracker/surf_golay/sg_detector.h"

namespace pleinair::tracker {
namespace {

/// Frames of a hand-held camera: two markers, one of which is sometimes covered.
std::vector<GreyImage> Frames(const CameraModel& camera) {
  std::vector<GreyImage> frames;
  for (int i = 0; i < 10; ++i) {
    std::vector<RenderedMarker> markers{
        SgMarkerAt(camera, 17, {55.0 + i % 5, 60}, 62, 20, 30, 5),
        SgMarkerAt(camera, 2000, {145.0 - i % 4, 62}, 56, 10, 80, 40)};
    if (i == 5 || i == 6) markers[1].cover = [](Vec2) { return 0.3; };
    frames.push_back(RenderMarkers(camera, markers, {.blur_px = 0.5, .noise_codes = 1.0}));
  }
  return frames;
}

TEST(SgMemory, HoldsTheSameMemoryAfterHundredsOfFrames) {
  const CameraModel camera = SgCamera(200, 120);
  const std::vector<GreyImage> frames = Frames(camera);
  const auto tracker = MakeSgTracker(camera, {.consecutive_frames = true});
  const auto go_round = [&](int times) {
    for (int i = 0; i < times; ++i) {
      for (const GreyImage& frame : frames) EXPECT_TRUE(tracker->Track(frame.view()).has_value());
    }
  };
  go_round(60);  // Until every buffer has met its largest frame; the last one did in round 45.
  const long before = LiveBytes();
  go_round(20);
  // The last round's frame and searches equal the first's; buffers may differ in slack.
  EXPECT_NEAR(static_cast<double>(LiveBytes()), static_cast<double>(before), 4096.0);
}

TEST(SgMemory, IsAskedForInAHandfulOfPiecesForATrackedMarker) {
  const CameraModel camera = SgCamera(200, 120);
  const GreyImage frame = Frames(camera)[0];
  const auto detector = SgDetector::Create(camera, {}, true);
  ASSERT_TRUE(detector.has_value());
  for (int i = 0; i < 31; ++i) ASSERT_EQ((*detector)->Detect(frame.view()).size(), 2U);
  const long before = Allocations();
  constexpr int kFrames = 14;  // Between two searches for borders of new markers.
  for (int i = 0; i < kFrames; ++i) ASSERT_EQ((*detector)->Detect(frame.view()).size(), 2U);
  const double a_marker = static_cast<double>(Allocations() - before) / (2 * kFrames);
  RecordProperty("allocations_a_marker_and_frame", std::to_string(a_marker));
  // The returned list with its visibility maps. No allocation per pixel, block or step.
  EXPECT_LT(a_marker, 20.0);
}

TEST(SgMemory, IsAskedForInFewPiecesWhereEverythingIsLookedFor) {
  const CameraModel camera = SgCamera(200, 120);
  const std::vector<GreyImage> frames = Frames(camera);
  const auto detector = SgDetector::Create(camera, {}, false);
  ASSERT_TRUE(detector.has_value());
  for (int round = 0; round < 2; ++round) {
    for (const GreyImage& frame : frames) (*detector)->Detect(frame.view());
  }
  const long before = Allocations();
  for (const GreyImage& frame : frames) (*detector)->Detect(frame.view());
  const double a_frame = static_cast<double>(Allocations() - before) / frames.size();
  RecordProperty("allocations_a_searched_frame", std::to_string(a_frame));
  // Quadrilaterals and guesses are tried one after another; none of that may grow with the pixels.
  EXPECT_LT(a_frame, 1500.0);
}

}  // namespace
}  // namespace pleinair::tracker
