// Depth of field from the command line.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

struct Drawn {
  nlohmann::json lens;
  cv::Mat image;
};

Drawn Replayed(const std::string& site, const std::string& out,
               const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"replay", site, "-o", out, "--frames", "--no-video"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const RunResult run = RunPleinair(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return {nlohmann::json::parse(ReadFile(out + "/report.json"))["lens"],
          cv::imread(out + "/frames/0000.png")};
}

TEST(Defocus, IsDrawnByLayersAsThroughManyPlacesOfTheStop) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  const std::vector<std::string> lens{"--focus", "1.2", "--aperture-mm", "25"};
  const Drawn off = Replayed(folder / "site", folder / "off", {"--defocus", "off"});
  EXPECT_EQ(off.lens["defocus"], "off");
  EXPECT_TRUE(off.lens["method"].is_null());

  const Drawn layered = Replayed(folder / "site", folder / "layered", lens);
  EXPECT_EQ(layered.lens["defocus"], "stated");
  EXPECT_EQ(layered.lens["method"], "layered");
  EXPECT_NEAR(layered.lens["focus_m"], 1.2, 1e-9);
  EXPECT_NEAR(layered.lens["aperture_mm"], 25.0, 1e-9);
  EXPECT_GT(layered.lens["largest_blur_px"], 2.0);
  EXPECT_GE(layered.lens["layers"], 1);
  EXPECT_TRUE(layered.lens["peels"].is_number());

  std::vector<std::string> through = lens;
  through.insert(through.end(), {"--defocus-method", "lens:32"});
  const Drawn places = Replayed(folder / "site", folder / "places", through);
  EXPECT_EQ(places.lens["method"], "lens:32");
  EXPECT_TRUE(places.lens["layers"].is_null());
  EXPECT_NEAR(places.lens["largest_blur_px"], layered.lens["largest_blur_px"], 0.2);

  const double blurred = cv::norm(off.image, places.image, cv::NORM_L2);
  EXPECT_GT(blurred, 100.0);
  EXPECT_LT(cv::norm(layered.image, places.image, cv::NORM_L2), 0.2 * blurred);
}

TEST(Defocus, OfAStatedLensIsThatOfTheScene) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  WriteFile(folder / "site/scene.toml",
            ReadFile(folder / "site/scene.toml") +
                "\n[lens]\nfocus_m = \"infinity\"\nf_number = 2.0\nfocal_length_mm = 10\n");
  const Drawn drawn = Replayed(folder / "site", folder / "out", {});
  EXPECT_EQ(drawn.lens["defocus"], "stated");
  EXPECT_TRUE(drawn.lens["focus_m"].is_null());
  EXPECT_NEAR(drawn.lens["aperture_mm"], 5.0, 1e-9);
}

TEST(Defocus, RefusesWhatNoLensHas) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  const auto refused = [&](const std::vector<std::string>& options, const std::string& message) {
    std::vector<std::string> arguments{"replay", folder / "site", "-o", folder / "out"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ExpectRefused(RunPleinair(arguments), message);
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  };
  refused({"--focus", "0"}, "--focus: is not greater than zero");
  refused({"--focus", "nan", "--aperture-mm", "5"}, "--focus: is not greater than zero");
  refused({"--aperture-mm", "-1"}, "--aperture-mm: is not greater than zero");
  refused({"--defocus", "stated"}, "--defocus stated: no aperture is stated");
  refused({"--defocus", "off", "--focus", "2"}, "--focus: has no effect with --defocus off");
  refused({"--defocus-method", "lens:0"}, "--defocus-method: is unknown: lens:0");
  refused({"--defocus-method", "lens:1025"}, "write layered, or lens:1 to lens:1024");
}

}  // namespace
}  // namespace pleinair::e2e
