// Motion blur and measured exposures from the command line.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/lens_recording.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

constexpr double kExposure_s = 0.025;

/// A camera that sways by up to 6 pixels an exposure.
LensRecording Swaying() {
  return {.farthest_m = 1.0,
          .nearest_m = 0.99,
          .aperture_m = 0.0,
          .rate_hz = 20.0,
          .frames = 24,
          .sway_px = 48.0,
          .exposure_s = kExposure_s};
}

nlohmann::json Replayed(const std::string& site, const std::string& out,
                        const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"replay", site, "-o", out, "--frames", "--no-video"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const RunResult run = RunPleinair(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return nlohmann::json::parse(ReadFile(out + "/report.json"));
}

double Difference(const std::string& a, const std::string& b, const char* frame) {
  return cv::norm(cv::imread(a + "/frames/" + frame), cv::imread(b + "/frames/" + frame),
                  cv::NORM_L2);
}

TEST(MotionBlur, IsDrawnByTheExposureThatTheMarkerShows) {
  const TemporaryFolder folder;
  const std::string site = folder / "site";
  WriteLensRecording(site, Swaying());
  const RunResult run = RunPleinair({"lens", site, "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto lens = nlohmann::json::parse(run.out);
  ASSERT_TRUE(lens["exposure_reason"].is_null()) << run.out;
  EXPECT_NEAR(lens["exposure_ms"], 1e3 * kExposure_s, 0.08 * 1e3 * kExposure_s);
  EXPECT_GT(lens["exposure_error_ms"], 0.0);

  const auto off = Replayed(site, folder / "off", {"--motion-blur", "off"})["motion"];
  EXPECT_EQ(off["mode"], "off");
  EXPECT_TRUE(off["exposure_ms"].is_null());
  EXPECT_EQ(off["longest_streak_px"], 0.0);
  const auto measured = Replayed(site, folder / "auto", {})["motion"];
  EXPECT_EQ(measured["mode"], "measured");
  EXPECT_NEAR(measured["exposure_ms"], lens["exposure_ms"], 0.01);
  EXPECT_NEAR(measured["exposure_error_ms"], lens["exposure_error_ms"], 0.01);
  EXPECT_GT(measured["longest_streak_px"], 4.5);
  EXPECT_LT(measured["longest_streak_px"], 12.0);
  EXPECT_GT(Difference(folder / "off", folder / "auto", "0012.png"), 100.0);

  Replayed(site, folder / "sharp", {"--look", "clean"});
  const auto stated =
      Replayed(site, folder / "streaks",
               {"--look", "clean", "--motion-blur", "stated", "--exposure-ms", "25"})["motion"];
  EXPECT_EQ(stated["mode"], "stated");
  EXPECT_NEAR(stated["exposure_ms"], 25.0, 1e-9);
  EXPECT_TRUE(stated["exposure_error_ms"].is_null());
  // Frame 12 is in the middle of a sway, frame 6 at its end.
  const double moving = Difference(folder / "sharp", folder / "streaks", "0012.png");
  EXPECT_GT(moving, 100.0);
  EXPECT_LT(Difference(folder / "sharp", folder / "streaks", "0006.png"), 0.5 * moving);
  // Too short to be seen: the same bytes.
  Replayed(site, folder / "short", {"--exposure-ms", "0.5"});
  EXPECT_EQ(Difference(folder / "off", folder / "short", "0012.png"), 0.0);
}

TEST(MotionBlur, TakesTheExposureOfSceneAndRecording) {
  const TemporaryFolder folder;
  const std::string site = folder / "site";
  LensRecording few = Swaying();
  few.frames = 3;
  few.more = R"(, "lens": {"exposure_ms": [10, 20, 15]})";
  WriteLensRecording(site, few);
  const auto recorded = Replayed(site, folder / "recorded", {})["motion"];
  EXPECT_EQ(recorded["mode"], "metadata");
  EXPECT_NEAR(recorded["exposure_ms"], 15.0, 1e-9);
  WriteFile(folder / "site/scene.toml",
            ReadFile(folder / "site/scene.toml") + "\n[lens]\nexposure_ms = 12.5\n");
  const auto stated = Replayed(site, folder / "stated", {"--motion-blur", "stated"})["motion"];
  EXPECT_EQ(stated["mode"], "stated");
  EXPECT_NEAR(stated["exposure_ms"], 12.5, 1e-9);

  few.more = R"(, "lens": {"exposure_ms": [10, 20]})";
  WriteLensRecording(site, few);
  ExpectRefused(RunPleinair({"replay", site, "-o", folder / "out"}),
                "has a list of 2 exposures for 3 frames");
}

TEST(MotionBlur, RefusesWhatNoShutterHas) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  const auto refused = [&](const std::vector<std::string>& options, const std::string& message) {
    std::vector<std::string> arguments{"replay", folder / "site", "-o", folder / "out"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ExpectRefused(RunPleinair(arguments), message);
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  };
  refused({"--exposure-ms", "0"}, "--exposure-ms: is not greater than zero");
  refused({"--exposure-ms", "nan"}, "--exposure-ms");
  refused({"--motion-blur", "stated"}, "--motion-blur stated: no exposure is stated");
  refused({"--motion-blur", "off", "--exposure-ms", "8"},
          "--exposure-ms: has no effect with --motion-blur off");
  refused({"--motion-blur", "measured", "--exposure-ms", "8"},
          "--exposure-ms: has no effect with --motion-blur measured");
}

TEST(MotionBlur, SaysWhyNoExposureIsMeasured) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 3, true);
  const auto report = Replayed(folder / "site", folder / "out", {"--motion-blur", "measured"});
  EXPECT_EQ(report["motion"]["mode"], "off");
  EXPECT_NE(report["warnings"].dump().find("The exposure could not be measured: "),
            std::string::npos);
}

}  // namespace
}  // namespace pleinair::e2e
