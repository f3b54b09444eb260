// Focus and aperture of a recording from the command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/e2e/command_output.h"
#include "tests/e2e/lens_recording.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

constexpr double kAperture_m = 0.012, kFocus_m = 1.1;

TEST(Lens, IsMeasuredOnTheMarkerAndDrawn) {
  const TemporaryFolder folder;
  WriteLensRecording(folder / "site", {.more = R"(, "lens": {"focus_m": 1.05})"});
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
  WriteLensRecording(folder / "site", {.farthest_m = 0.82, .nearest_m = 0.8});
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
