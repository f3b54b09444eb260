#include <gmock/gmock.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/e2e/marker_recording.h"
#include "tests/e2e/run_program.h"
#include "tests/tracker/marker_rendering.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kFrameCount = 12;

/// Two markers; number 17 is hidden in frames 3 to 5, number 18 in frame 8, both in frame 7.
void WriteTwoMarkers(const fs::path& folder) {
  CameraModel camera;
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 300.0;
  camera.cx = 159.5;
  camera.cy = 119.5;
  const Transform<Marker, Marker> reference_from_anchor{Mat3{}, {0.3, 0.05, 0.0}};
  std::vector<std::vector<ShownMarker>> frames(kFrameCount);
  for (int i = 0; i < kFrameCount; ++i) {
    const Transform<Camera, Marker> pose =
        tracker::PoseAtPixel(camera, {90.0 + i, 120.0}, 85.0, Metres(0.2), Radians(0.6),
                             Radians(0.5), Radians(0.02 * i));
    std::vector<ShownMarker>& shown = frames[static_cast<std::size_t>(i)];
    if (!(i >= 3 && i <= 5) && i != 7) shown.push_back({17, pose});
    if (i != 7 && i != 8) shown.push_back({18, pose * reference_from_anchor});
  }
  WriteMarkerRecording(folder, camera, frames, "[[anchor]]\nid = 18\n");
}

TEST(Anchors, GiveThePoseWhereTheMarkerIsHidden) {
  const TemporaryFolder folder;
  WriteTwoMarkers(folder / "site");
  const RunResult run =
      RunPleinair({"replay", folder / "site", "-o", folder / "out", "--no-video"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string text = ReadFile(folder / "out/report.json");
  const auto report = nlohmann::json::parse(text);
  EXPECT_EQ(report["frames_with_pose"], kFrameCount);
  const auto& anchors = report["anchors"];
  EXPECT_EQ(anchors["frames_by_anchors"], 3);
  EXPECT_EQ(anchors["filled_frames"], 1);
  EXPECT_EQ(anchors["gaps"], 1);
  EXPECT_EQ(anchors["markers"][0]["marker"], "sg_18");
  EXPECT_EQ(anchors["markers"][0]["place"], "found");
  EXPECT_NEAR(anchors["markers"][0]["translation_m"][0].get<double>(), 0.3, 0.002);
  EXPECT_NEAR(anchors["markers"][0]["translation_m"][1].get<double>(), 0.05, 0.002);
  EXPECT_THAT(text, HasSubstr("3 frames have their pose from the anchors alone"));
  EXPECT_THAT(text,
              HasSubstr("1 frames show no marker and have their pose from the camera's motion"));
}

}  // namespace
}  // namespace pleinair::e2e
