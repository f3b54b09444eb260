#include "tests/e2e/marker_recording.h"

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/e2e/run_program.h"
#include "tests/tracker/marker_rendering.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::e2e {

void WriteMarkerRecording(const std::filesystem::path& folder, const CameraModel& camera,
                          const std::vector<std::vector<ShownMarker>>& frames,
                          const std::string& more) {
  std::filesystem::create_directories(folder / "frames");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::vector<tracker::RenderedMarker> markers;
    for (const ShownMarker& shown : frames[i]) {
      tracker::RenderedMarker& marker = markers.emplace_back();
      marker.pattern =
          std::make_shared<const tracker::MarkerPattern>(tracker::SgMarkerPattern(shown.number));
      marker.size = Metres(0.2);
      marker.camera_from_marker = shown.camera_from_marker;
    }
    GreyImage grey = tracker::RenderMarkers(camera, markers, {});
    cv::imwrite((folder / fmt::format("frames/{:03}.png", i)).string(),
                cv::Mat(grey.height(), grey.width(), CV_8UC1, grey.data()));
  }
  WriteFile(folder / "recording.json",
            fmt::format(R"({{"frames": "frames", "frame_rate_hz": 30, "calibration": {{
                "image_width": {}, "image_height": {}, "model": "opencv-radtan", "fx": {}, "fy": {},
                "cx": {}, "cy": {}, "distortion_k1_k2_p1_p2_k3": [0, 0, 0, 0, 0]}}}})",
                        camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy));
  WriteFile(folder / "scene.toml",
            "time = \"2025-09-14T11:05:00Z\"\n[place]\nlatitude_deg = 50\nlongitude_deg = 14\n"
            "[marker]\nfamily = \"sg\"\nid = 17\nsize_mm = 200\nheading_deg = 0\n" +
                more);
}

}  // namespace pleinair::e2e
