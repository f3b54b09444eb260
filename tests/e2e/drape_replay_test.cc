// Maps on the ground of composed pictures.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "app/compare/ciede2000.h"
#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

std::string Plan(const std::string& type, const std::string& coordinates) {
  return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},)"
         R"("geometry":{"type":")" +
         type + R"(","coordinates":)" + coordinates + "}}]}";
}

constexpr const char* kAcross = "[[-0.5,0.5],[0.6,0.5]]";

struct Replayed {
  nlohmann::json report;
  cv::Mat picture;
};

/// Replays one frame with a map. `keys`: of the [[drape]].
Replayed ReplayWithMap(const TemporaryFolder& folder, const std::string& name,
                       const std::string& plan, const std::string& keys, bool with_object) {
  MakeShortRecording(folder / name, 1, with_object);
  WriteFile(folder / name / "plan.geojson", plan);
  WriteFile(folder / name / "scene.toml",
            ReadFile(folder / name / "scene.toml") +
                "\n[[drape]]\nfile = \"plan.geojson\"\ncrs = \"marker\"\n" + keys);
  const std::filesystem::path out = folder / (name + "_out");
  const RunResult run = RunPleinair({"replay", folder / name, "-o", out, "--frames", "--no-video"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return {nlohmann::json::parse(ReadFile(out / "report.json")),
          cv::imread(out / "frames/0000.png")};
}

/// Where the bundled recording's first frame shows a point of the marker's plane.
cv::Point Pixel(double x_m, double y_m) {
  static const auto scene = nlohmann::json::parse(ReadFile(BundledRecording() / "scene.json"));
  const auto& pose = scene["poses_marker_to_camera"][0];
  std::array<double, 3> at{};
  for (std::size_t r = 0; r < 3; ++r) {
    at[r] =
        pose[r][0].get<double>() * x_m + pose[r][1].get<double>() * y_m + pose[r][3].get<double>();
  }
  const auto& lens = scene["intrinsics"];
  return {static_cast<int>(
              std::lround(lens["fx"].get<double>() * at[0] / at[2] + lens["cx"].get<double>())),
          static_cast<int>(
              std::lround(lens["fy"].get<double>() * at[1] / at[2] + lens["cy"].get<double>()))};
}

/// `bgr`: a pixel or a mean of pixels.
app::Lab LabOf(const cv::Vec3d& bgr) {
  std::array<std::uint8_t, 3> rgb{};
  for (int c = 0; c < 3; ++c) {
    rgb[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(bgr[2 - c]));
  }
  return app::LabFromSrgb8(rgb);
}

TEST(DrapeReplay, DrawsAMapWithoutAVirtualObject) {
  const TemporaryFolder folder;
  const Replayed drawn = ReplayWithMap(folder, "site", Plan("LineString", kAcross),
                                       "line_width_m = 0.06\ncolor = \"#000000\"\n", false);
  const cv::Mat frame = cv::imread(folder / "site/frames/0000.jpg");
  ASSERT_EQ(drawn.picture.size(), frame.size());
  EXPECT_EQ(drawn.picture.at<cv::Vec3b>(Pixel(0.2, 0.5)), cv::Vec3b(0, 0, 0));
  // Two decoders of one JPEG may differ by a code.
  for (const cv::Point beside : {Pixel(0.2, 0.6), Pixel(0.0, 0.0)}) {
    EXPECT_LE(cv::norm(drawn.picture.at<cv::Vec3b>(beside), frame.at<cv::Vec3b>(beside)), 3.0);
  }
  const auto& content = drawn.report["content"];
  ASSERT_EQ(content.size(), 1U);
  EXPECT_EQ(content[0]["kind"], "drape");
  EXPECT_EQ(content[0]["features"], 1);
  EXPECT_EQ(content[0]["vertices_in"], 2);
  EXPECT_GE(content[0]["vertices_out"], 2);
  EXPECT_EQ(content[0]["off_target"], 0);
}

TEST(DrapeReplay, PaintHasTheColorOfThePrintsPaper) {
  // Paper of reflectance 0.8 beside the print, whose white margin has the same.
  const TemporaryFolder folder;
  const Replayed drawn = ReplayWithMap(
      folder, "site",
      Plan("Polygon", "[[[0.33,-0.2],[0.43,-0.2],[0.43,0.2],[0.33,0.2],[0.33,-0.2]]]"),
      "line_width_m = 0.001\nblend = \"paint\"\ncolor = \"#e7e7e7\"\nfill = \"#e7e7e7\"\n", true);
  for (const double y : {-0.15, 0.0, 0.15}) {
    cv::Vec3d paper(0, 0, 0), paint(0, 0, 0);
    for (int i = -2; i <= 2; ++i) {
      paper += drawn.picture.at<cv::Vec3b>(Pixel(0.275, y + 0.01 * i));
      paint += drawn.picture.at<cv::Vec3b>(Pixel(0.38, y + 0.01 * i));
    }
    EXPECT_LE(app::Ciede2000(LabOf(paint / 5), LabOf(paper / 5)), 3.0) << y;
  }
}

TEST(DrapeReplay, TellsWhatItLeavesOut) {
  const TemporaryFolder folder;
  const Replayed drawn =
      ReplayWithMap(folder, "site", Plan("LineString", kAcross),
                    "offset_m = 1.5\nhidden = \"ghost\"\nlive = \"screen\"\n", false);
  const std::string warnings = drawn.report["warnings"].dump();
  for (const char* part : {"above or below it are not drawn", "ghost", "draped exactly"}) {
    EXPECT_NE(warnings.find(part), std::string::npos) << part << " in " << warnings;
  }
}

TEST(DrapeReplay, RefusesAMapThatItCannotPlace) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, false);
  const std::string scene = ReadFile(folder / "site/scene.toml");
  const auto refused = [&](const std::string& keys, const std::string& message) {
    WriteFile(folder / "site/scene.toml", scene + "\n[[drape]]\n" + keys);
    ExpectRefused(RunPleinair({"replay", folder / "site", "-o", folder / "out"}), message);
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  };
  refused("file = \"missing.geojson\"\ncrs = \"marker\"\n", "missing.geojson");
  WriteFile(folder / "site/far.geojson", Plan("LineString", "[[500,0],[600,0]]"));
  refused("file = \"far.geojson\"\ncrs = \"marker\"\n", "far.geojson");
}

}  // namespace
}  // namespace pleinair::e2e
