// Focus and aperture of a recording from the command line.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"
#include "tests/tracker/lens_rendering.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::e2e {
namespace {

constexpr double kAperture_m = 0.012, kFocus_m = 1.1, kFx = 605.0;
const CameraModel kLensCamera{
    .width = 320, .height = 240, .fx = kFx, .fy = kFx, .cx = 159.5, .cy = 119.5};

/// A recording of a print through a lens, from one distance to another. It has a box to draw.
void WriteLensRecording(const std::filesystem::path& folder, double farthest_m, double nearest_m,
                        const std::string& more = {}) {
  constexpr int kFrames = 12;
  std::filesystem::create_directories(folder / "frames");
  for (int i = 0; i < kFrames; ++i) {
    const double share = (i + 0.5) / kFrames;
    const double tilt = 0.4 + 0.1 * std::sin(2.0 * i), roll = 0.3 * std::sin(1.3 * i);
    const double c = std::cos(tilt), s = std::sin(tilt), u = std::cos(roll), v = std::sin(roll);
    tracker::LensPicture picture;
    picture.pattern = std::make_shared<const tracker::MarkerPattern>(tracker::SgMarkerPattern(17));
    picture.size = Metres(0.2);
    const Transform<Camera, Marker> pose{
        Mat3{{u, -v, 0, v, u, 0, 0, 0, 1}} * Mat3{{1, 0, 0, 0, -c, s, 0, -s, -c}},
        {0.005, -0.004, farthest_m + share * (nearest_m - farthest_m)}};
    picture.camera_from_marker = [pose](double) { return pose; };
    picture.aperture_m = kAperture_m;
    picture.focus_dioptres = 1.0 / kFocus_m;
    picture.own_blur_px = 0.3;
    picture.noise_codes = 1.0;
    picture.seed = static_cast<std::uint32_t>(i + 1);
    GreyImage grey = tracker::RenderThroughLens(kLensCamera, picture);
    cv::imwrite((folder / fmt::format("frames/{:03}.png", i)).string(),
                cv::Mat(grey.height(), grey.width(), CV_8UC1, grey.data()));
  }
  WriteFile(folder / "recording.json",
            fmt::format(R"({{"frames": "frames", "frame_rate_hz": 2, "calibration": {{
                "image_width": 320, "image_height": 240, "model": "opencv-radtan", "fx": {0},
                "fy": {0}, "cx": 159.5, "cy": 119.5,
                "distortion_k1_k2_p1_p2_k3": [0, 0, 0, 0, 0]}}{1}}})",
                        kFx, more));
  WriteFile(folder / "box.obj",
            "v 0 0 0\nv 0.05 0 0\nv 0.05 0.05 0\nv 0 0.05 0\nv 0 0 0.3\nv 0.05 0 0.3\n"
            "v 0.05 0.05 0.3\nv 0 0.05 0.3\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\n"
            "f 3 4 8 7\nf 4 1 5 8\n");
  WriteFile(folder / "scene.toml",
            "time = \"2025-09-14T11:05:00Z\"\n[place]\nlatitude_deg = 50\nlongitude_deg = 14\n"
            "[marker]\nfamily = \"sg\"\nid = 17\nsize_mm = 200\nheading_deg = 0\n"
            "[[object]]\nfile = \"box.obj\"\n");
}

TEST(Lens, IsMeasuredOnTheMarkerAndDrawn) {
  const TemporaryFolder folder;
  WriteLensRecording(folder / "site", 1.7, 0.6, R"(, "lens": {"focus_m": 1.05})");
  const RunResult run =
      RunPleinair({"lens", folder / "site", "--json", "--csv", folder / "blur.csv"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto lens = nlohmann::json::parse(run.out);
  ASSERT_TRUE(lens["measured"]) << run.out;
  EXPECT_TRUE(lens["reason"].is_null());
  EXPECT_NEAR(lens["focus_dioptres"], 1.0 / kFocus_m, 0.03);
  EXPECT_NEAR(lens["focus_m"], kFocus_m, 0.04);
  EXPECT_NEAR(lens["aperture_mm"], 1e3 * kAperture_m, 0.06 * 1e3 * kAperture_m);
  EXPECT_GT(lens["focus_dioptres_error"], 0.0);
  EXPECT_LT(lens["aperture_relative_error"], 0.06);
  EXPECT_NEAR(lens["in_focus_blur_px"], 0.42, 0.05);
  EXPECT_NEAR(lens["nearest_m"], 0.65, 0.06);
  EXPECT_NEAR(lens["farthest_m"], 1.65, 0.06);
  EXPECT_NEAR(lens["metadata"]["focus_m"], 1.05, 1e-9);
  EXPECT_TRUE(lens["metadata"]["aperture_mm"].is_null());
  const std::string csv = ReadFile(folder / "blur.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "frame,timestamp_s,side,distance_m,blur_px");
  EXPECT_GT(std::count(csv.begin(), csv.end(), '\n'), 30);

  const RunResult replayed = RunPleinair(
      {"replay", folder / "site", "-o", folder / "out", "--no-video", "--defocus", "measured"});
  ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
  const auto drawn = nlohmann::json::parse(ReadFile(folder / "out/report.json"))["lens"];
  EXPECT_EQ(drawn["defocus"], "measured");
  EXPECT_NEAR(drawn["focus_m"], lens["focus_m"], 0.01);
  EXPECT_NEAR(drawn["focus_dioptres_error"], lens["focus_dioptres_error"], 0.002);
  EXPECT_GT(drawn["aperture_relative_error"], 0.0);
  EXPECT_GT(drawn["largest_blur_px"], 1.0);
  const std::string page = ReadFile(folder / "out/report.html");
  EXPECT_NE(page.find("Blur over the reciprocal distance"), std::string::npos);
}

TEST(Lens, IsNotMeasuredAtOneDistance) {
  const TemporaryFolder folder;
  WriteLensRecording(folder / "site", 0.82, 0.8);
  const RunResult run = RunPleinair({"lens", folder / "site", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto lens = nlohmann::json::parse(run.out);
  EXPECT_FALSE(lens["measured"]);
  EXPECT_EQ(lens["reason"], "the marker's distance hardly changes");
  EXPECT_TRUE(lens["focus_m"].is_null());
  EXPECT_TRUE(lens["metadata"].is_null());
  const RunResult replayed = RunPleinair(
      {"replay", folder / "site", "-o", folder / "out", "--no-video", "--defocus", "measured"});
  ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
  const auto report = nlohmann::json::parse(ReadFile(folder / "out/report.json"));
  EXPECT_EQ(report["lens"]["defocus"], "off");
  EXPECT_NE(report["warnings"].dump().find("could not be measured: the marker's distance"),
            std::string::npos);
  ExpectRefused(RunPleinair({"live", "--camera", "file:" + (folder / "site").string(), "--headless",
                             "--defocus", "measured"}),
                "--defocus measured: takes a whole recording");
}

TEST(Lens, RefusesWhatItCannotRead) {
  const TemporaryFolder folder;
  ExpectRefused(RunPleinair({"lens", folder / "none"}), "none: there is no such recording");
  std::filesystem::create_directories(folder / "empty");
  ExpectRefused(RunPleinair({"lens", folder / "empty"}), "empty");
  WriteFile(folder / "a.png", "x");
  ExpectRefused(RunPleinair({"lens", folder / "a.png", "--csv", folder / "a.png"}), "a.png");
  ExpectRefused(RunPleinair({"replay", folder / "empty", "-o", folder / "out", "--defocus",
                             "measured", "--focus", "2"}),
                "--focus: has no effect with --defocus measured");
}

}  // namespace
}  // namespace pleinair::e2e
