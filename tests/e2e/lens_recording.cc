#include "tests/e2e/lens_recording.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/e2e/run_program.h"
#include "tests/tracker/lens_rendering.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::e2e {
namespace {

constexpr double kFx = 605.0;
const CameraModel kLensCamera{
    .width = 320, .height = 240, .fx = kFx, .fy = kFx, .cx = 159.5, .cy = 119.5};

}  // namespace

void WriteLensRecording(const std::filesystem::path& folder, const LensRecording& how) {
  std::filesystem::create_directories(folder / "frames");
  for (int i = 0; i < how.frames; ++i) {
    const double share = (i + 0.5) / how.frames;
    const double distance_m = how.farthest_m + share * (how.nearest_m - how.farthest_m);
    // A sway shows the camera's motion, without others.
    const double turns = how.sway_px > 0.0 ? 0.0 : 1.0;
    const double tilt = 0.4 + turns * 0.1 * std::sin(2.0 * i);
    const double roll = turns * 0.3 * std::sin(1.3 * i);
    const double c = std::cos(tilt), s = std::sin(tilt), u = std::cos(roll), v = std::sin(roll);
    tracker::LensPicture picture;
    picture.pattern = std::make_shared<const tracker::MarkerPattern>(tracker::SgMarkerPattern(17));
    picture.size = Metres(0.2);
    const Transform<Camera, Marker> pose{
        Mat3{{u, -v, 0, v, u, 0, 0, 0, 1}} * Mat3{{1, 0, 0, 0, -c, s, 0, -s, -c}},
        {0.005, -0.004, distance_m}};
    picture.camera_from_marker = [&how, pose, i, distance_m](double exposures) {
      const double time_s = i / how.rate_hz + exposures * how.exposure_s;
      Transform<Camera, Marker> moved = pose;
      moved.translation_m.x +=
          how.sway_px * distance_m / kFx * std::sin(2.0 * std::numbers::pi * how.sways_hz * time_s);
      return moved;
    };
    picture.aperture_m = how.aperture_m;
    picture.focus_dioptres = 1.0 / how.focus_m;
    picture.own_blur_px = 0.3;
    picture.noise_codes = 1.0;
    picture.seed = static_cast<std::uint32_t>(i + 1);
    GreyImage grey = tracker::RenderThroughLens(kLensCamera, picture);
    cv::imwrite((folder / fmt::format("frames/{:03}.png", i)).string(),
                cv::Mat(grey.height(), grey.width(), CV_8UC1, grey.data()));
  }
  WriteFile(folder / "recording.json",
            fmt::format(R"({{"frames": "frames", "frame_rate_hz": {2}, "calibration": {{
                "image_width": 320, "image_height": 240, "model": "opencv-radtan", "fx": {0},
                "fy": {0}, "cx": 159.5, "cy": 119.5,
                "distortion_k1_k2_p1_p2_k3": [0, 0, 0, 0, 0]}}{1}}})",
                        kFx, how.more, how.rate_hz));
  WriteFile(folder / "box.obj",
            "v 0 0 0\nv 0.05 0 0\nv 0.05 0.05 0\nv 0 0.05 0\nv 0 0 0.3\nv 0.05 0 0.3\n"
            "v 0.05 0.05 0.3\nv 0 0.05 0.3\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\n"
            "f 3 4 8 7\nf 4 1 5 8\n");
  WriteFile(folder / "scene.toml",
            "time = \"2025-09-14T11:05:00Z\"\n[place]\nlatitude_deg = 50\nlongitude_deg = 14\n"
            "[marker]\nfamily = \"sg\"\nid = 17\nsize_mm = 200\nheading_deg = 0\n"
            "[[object]]\nfile = \"box.obj\"\n");
}

}  // namespace pleinair::e2e
