#include "accuracy/frame_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "accuracy/detector.h"
#include "accuracy/occluders.h"
#include "accuracy/sweeps.h"
#include "tests/tracker/marker_rendering.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::accuracy {
namespace {

std::shared_ptr<const tracker::MarkerPattern> SgPattern(int number) {
  return std::make_shared<tracker::MarkerPattern>(tracker::SgMarkerPattern(number));
}

FrameSpec FrontFrame(double side_px) {
  const CameraModel camera = SweepCamera("640x480");
  return MakeSweep("distance", camera, {.seed = 3, .scale = 0.01})
      .at(side_px == 200 ? 0 : 8)
      .frames.at(0);
}

// The tracker's test renderer uses 144 point samples per pixel and shares only the geometry.
TEST(FrameRenderer, SeesWhatASlowRendererOfPointSamplesSees) {
  const CameraModel camera = SweepCamera("640x480");
  FrameSpec frame = FrontFrame(42);
  frame.photo = {.lens = {.psf_px = 0.05, .vignette = 0.0}, .noise = {.shot = 0.0, .read = 0.0}};
  const RenderedFrame ours = FrameRenderer(camera, SgPattern, 1, 1).Render(frame);
  tracker::RenderedMarker marker;
  marker.pattern = SgPattern(frame.markers[0].number);
  marker.size = kMarkerEdge;
  marker.camera_from_marker = frame.markers[0].camera_from_marker;
  marker.black = 0.035;
  marker.white = 0.82;
  const GreyImage theirs = tracker::RenderMarkers(camera, {marker}, {});
  // Inside the black square the background has no effect.
  Vec2 middle;
  for (const Vec2 corner : ours.truth[0].corners_px) middle = middle + corner * 0.25;
  double sum = 0.0;
  int largest = 0, count = 0;
  for (int y = static_cast<int>(middle.y) - 12; y <= middle.y + 12; ++y) {
    for (int x = static_cast<int>(middle.x) - 12; x <= middle.x + 12; ++x) {
      const int difference = std::abs(ours.grey(x, y) - theirs(x, y));
      sum += difference;
      largest = std::max(largest, difference);
      ++count;
    }
  }
  EXPECT_LT(sum / count, 0.8);  // Pixel values of 255.
  EXPECT_LE(largest, 8);  // Twelve point samples resolve an edge to a twelfth of its contrast.
}

// FNV-1a hash of a frame with occluder, blur, shadow and noise. It is the same for every compiler.
TEST(FrameRenderer, GivesTheSameBytesEverywhere) {
  const CameraModel camera = SweepCamera("640x480");
  const auto frames = MakeSweep("wild", camera, {.seed = 7, .scale = 0.02});
  FrameRenderer renderer(camera, SgPattern, 7, 7);
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const FrameRun& run : frames) {
    const GreyImage grey = renderer.Render(run.frames[0]).grey;
    for (std::size_t i = 0; i < grey.size(); ++i) hash = (hash ^ grey.data()[i]) * 0x100000001b3;
  }
  EXPECT_EQ(hash, 0x87552f62461d3a04ULL) << std::hex << hash;
}

TEST(FrameRenderer, ChangesTheNoiseAloneWithItsSeed) {
  const CameraModel camera = SweepCamera("640x480");
  const FrameSpec frame = FrontFrame(200);
  const RenderedFrame a = FrameRenderer(camera, SgPattern, 1, 1).Render(frame);
  const RenderedFrame b = FrameRenderer(camera, SgPattern, 1, 2).Render(frame);
  double difference = 0.0;
  for (std::size_t i = 0; i < a.grey.size(); ++i) {
    difference += std::abs(a.grey.data()[i] - b.grey.data()[i]);
  }
  difference /= static_cast<double>(a.grey.size());
  EXPECT_GT(difference, 0.2);
  EXPECT_LT(difference, 6.0);
}

TEST(Occluders, CoverWhatTheyAreAskedTo) {
  for (const std::string& pattern : BorderPatterns()) {
    const double share = std::min(0.2, MaxShare(pattern));
    const Occluder occluder = MakeOccluder({pattern, share, "key"}, 1);
    EXPECT_NEAR(occluder.shares.border, share, 0.01) << pattern;
    if (pattern == "hand") continue;
    EXPECT_NEAR(occluder.shares.content, 0.0, 0.005) << pattern;
  }
  for (const std::string& pattern : ContentPatterns()) {
    const Occluder occluder = MakeOccluder({pattern, 0.25, "key"}, 1);
    EXPECT_NEAR(occluder.shares.content, 0.25, 0.015) << pattern;
  }
}

TEST(Sweeps, GiveASubsetOfTheSameFramesAtASmallerScale) {
  const CameraModel camera = SweepCamera("640x480");
  for (const std::string& name : SweepNames()) {
    std::set<std::string> all;
    std::size_t frames = 0;
    for (const FrameRun& run : MakeSweep(name, camera, {.seed = 2, .scale = 0.5})) {
      for (const FrameSpec& frame : run.frames) all.insert(frame.name);
      frames += run.frames.size();
    }
    EXPECT_EQ(all.size(), frames) << name << ": names are unique";
    for (const FrameRun& run : MakeSweep(name, camera, {.seed = 2, .scale = 0.25})) {
      for (const FrameSpec& frame : run.frames) EXPECT_TRUE(all.contains(frame.name)) << frame.name;
    }
  }
}

// Checks the peers' markers, corner order and pixel origin. If one were wrong, the numbers or the
// mean corner error below a tenth of a pixel would be impossible.
TEST(Peers, FindTheirOwnPrints) {
  const CameraModel camera = SweepCamera("640x480");
  const FrameSpec frame = FrontFrame(200);
  for (const bool aruco : {false, true}) {
    const auto peer = aruco ? MakeArucoPeer(camera) : MakeAprilTagPeer(camera);
    ASSERT_TRUE(peer->Start(false).has_value());
    const RenderedFrame seen = FrameRenderer(camera, peer->Patterns(), 1, 1).Render(frame);
    const auto found = peer->Detect(seen.grey.view());
    ASSERT_TRUE(found.has_value());
    FrameRecord record;
    Score(seen.truth, found->markers, &record);
    ASSERT_EQ(record.markers[0].outcome, Outcome::kHit) << (aruco ? "aruco" : "apriltag");
    Vec2 mean;
    for (const Vec2 error : record.markers[0].corner_error_px) mean = mean + error * 0.25;
    EXPECT_LT(Norm(mean), 0.15);
    ASSERT_TRUE(record.markers[0].pose.has_value());
    EXPECT_LT(record.markers[0].pose->rotation_error_deg, 2.0);
  }
}

}  // namespace
}  // namespace pleinair::accuracy
