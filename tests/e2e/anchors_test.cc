#include <gmock/gmock.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/e2e/run_program.h"
#include "tests/tracker/marker_rendering.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kFrameCount = 12;

tracker::RenderedMarker MarkerOf(int number, const Transform<Camera, Marker>& pose) {
  tracker::RenderedMarker marker;
  marker.pattern = std::make_shared<const tracker::MarkerPattern>(tracker::SgMarkerPattern(number));
  marker.size = Metres(0.2);
  marker.camera_from_marker = pose;
  return marker;
}

/// Two markers; number 17 is hidden in frames 3 to 5, number 18 in frame 8, both in frame 7.
void WriteTwoMarkers(const fs::path& folder) {
  CameraModel camera;
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 300.0;
  camera.cx = 159.5;
  camera.cy = 119.5;
  fs::create_directories(folder / "frames");
  const Transform<Marker, Marker> reference_from_anchor{Mat3{}, {0.3, 0.05, 0.0}};
  for (int i = 0; i < kFrameCount; ++i) {
    const Transform<Camera, Marker> pose =
        tracker::PoseAtPixel(camera, {90.0 + i, 120.0}, 85.0, Metres(0.2), Radians(0.6),
                             Radians(0.5), Radians(0.02 * i));
    std::vector<tracker::RenderedMarker> markers;
    if (!(i >= 3 && i <= 5) && i != 7) markers.push_back(MarkerOf(17, pose));
    if (i != 7 && i != 8) markers.push_back(MarkerOf(18, pose * reference_from_anchor));
    GreyImage grey = tracker::RenderMarkers(camera, markers, {});
    cv::imwrite((folder / ("frames/" + std::to_string(100 + i) + ".png")).string(),
                cv::Mat(grey.height(), grey.width(), CV_8UC1, grey.data()));
  }
  WriteFile(folder / "recording.json",
            R"({"frames": "frames", "frame_rate_hz": 30, "calibration": {"image_width": 320,
                "image_height": 240, "model": "opencv-radtan", "fx": 300, "fy": 300, "cx": 159.5,
                "cy": 119.5, "distortion_k1_k2_p1_p2_k3": [0, 0, 0, 0, 0]}})");
  WriteFile(folder / "scene.toml",
            "time = \"2025-09-14T11:05:00Z\"\n[place]\nlatitude_deg = 50\nlongitude_deg = 14\n"
            "[marker]\nid = 17\nsize_mm = 200\nheading_deg = 0\n[[anchor]]\nid = 18\n");
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
