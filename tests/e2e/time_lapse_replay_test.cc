// Tests `pleinair replay --time-lapse` as a process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/e2e/run_program.h"
#include "tests/temporary_folder.h"

namespace pleinair::e2e {
namespace {

using ::testing::HasSubstr;

TEST(TimeLapseReplay, DrawsTheLeavesOfEachDate) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  WriteFile(folder / "site/ground.obj", "v -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nf 1 2 3 4\n");
  WriteFile(folder / "site/leaf.obj",
            "mtllib leaf.mtl\nusemtl blade\nv -0.4 -0.4 0.3\nv 0.4 -0.4 0.3\nv 0.4 0.4 0.3\n"
            "v -0.4 0.4 0.3\nf 1 2 3 4\n");
  WriteFile(folder / "site/leaf.mtl", "newmtl blade\nKd 0.1 0.2 0.1\n");
  WriteFile(folder / "season.toml",
            "[[phantom]]\nfile = \"site/ground.obj\"\n[[object]]\nfile = \"site/leaf.obj\"\n"
            "[[leaf]]\nmaterials = [\"blade\"]\nwater_cm = 0.012\ndry_g_cm2 = 0.005\n"
            "[[leaf.stage]]\ndate = 2025-05-15\nchlorophyll_ug_cm2 = 40\n"
            "carotenoids_ug_cm2 = 9\n"
            "[[leaf.stage]]\ndate = 2025-10-15\nchlorophyll_ug_cm2 = 1\n"
            "carotenoids_ug_cm2 = 8\nbrown = 0.5\n");
  const RunResult run =
      RunPleinair({"replay", folder / "site", "--scene", folder / "season.toml", "-o",
                   folder / "out", "--no-video", "--light", "stated", "--size", "160x120",
                   "--frames", "--time-lapse", "2025-05-15..2025-10-15@13:00", "--every", "153d"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const cv::Mat may = cv::imread(folder / "out/timelapse/0000.png");
  const cv::Mat october = cv::imread(folder / "out/timelapse/0001.png");
  ASSERT_FALSE(may.empty() || october.empty());
  EXPECT_FALSE(std::filesystem::exists(folder / "out/timelapse/0002.png"));
  double red = 0.0, green = 0.0;
  int count = 0;
  for (int y = 0; y < may.rows; ++y) {
    for (int x = 0; x < may.cols; ++x) {
      const auto in_may = may.at<cv::Vec3b>(y, x), later = october.at<cv::Vec3b>(y, x);
      if (in_may[1] < in_may[0] + 30 || in_may[1] < in_may[2] + 20) continue;
      green += later[1];
      red += later[2];
      ++count;
    }
  }
  EXPECT_GT(count, 300);
  EXPECT_GT(red, 1.1 * green) << count;
}

TEST(TimeLapseReplay, LetsTheShadowsOfCloudsTravelOverGroundAndObject) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  const std::string scene = ReadFile(folder / "site/scene.toml");
  WriteFile(folder / "site/clouds.toml",
            scene +
                "[[cloud_layer]]\nkind = \"cumulus\"\noptical_depth = 40\ncell_m = 400\n"
                "wind_m_s = 20\nwind_from_deg = 270\n");
  const RunResult run =
      RunPleinair({"replay", folder / "site", "--scene", folder / "site/clouds.toml", "-o",
                   folder / "out", "--no-video", "--light", "stated", "--size", "160x120",
                   "--frames", "--time-lapse", "13:05..13:07+02:00", "--every", "20s"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  double darkest = 255.0, brightest = 0.0;
  for (int i = 0; i <= 6; ++i) {
    const std::string name = "000" + std::to_string(i) + ".png";
    const cv::Mat picture = cv::imread(folder / "out/timelapse" / name);
    ASSERT_FALSE(picture.empty()) << i;
    const double ground = cv::mean(picture.rowRange(100, 120))[1];
    darkest = std::min(darkest, ground);
    brightest = std::max(brightest, ground);
  }
  EXPECT_GT(brightest, 1.3 * darkest);
}

TEST(StatedLight, IsThatOfTheLayersOfClouds) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, true);
  const std::string scene = ReadFile(folder / "site/scene.toml");
  WriteFile(folder / "site/clouds.toml",
            tests::Replaced(scene, "\"clear\"", "\"overcast\"") +
                "[[cloud_layer]]\nkind = \"slab\"\noptical_depth = 0.5\n");
  const auto light = [&](const char* file, const char* changes) {
    const RunResult run = RunPleinair({"replay", folder / "site", "--scene", folder / "site" / file,
                                       "-o", folder / "out", "--no-video", "--light", "stated",
                                       "--size", "160x120", "--light-changes", changes});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return nlohmann::json::parse(ReadFile(folder / "out/report.json"));
  };
  const auto clear = light("scene.toml", "hold"), stated = light("clouds.toml", "stated");
  EXPECT_EQ(stated["light"]["changes"]["mode"], "stated");
  EXPECT_EQ(stated["light"]["changes"]["frames_by_source"], (nlohmann::json{{"layers", 2}}));
  const double rise = std::sin(stated["light"]["sun_elevation_deg"].get<double>() * M_PI / 180.0);
  EXPECT_NEAR(stated["light"]["sun_normal_lux"].get<double>() /
                  clear["light"]["sun_normal_lux"].get<double>(),
              std::exp(-0.5 / rise), 0.01);
  EXPECT_GT(stated["light"]["sky_horizontal_lux"].get<double>(),
            1.2 * clear["light"]["sky_horizontal_lux"].get<double>());
  EXPECT_THAT(stated["warnings"].dump(), HasSubstr("layers of clouds of the scene are its clouds"));
}

TEST(StatedLight, NeedsLayersOfClouds) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  const RunResult run =
      RunPleinair({"replay", folder / "site", "-o", folder / "out", "--light-changes", "stated"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("has no layers of clouds for --light-changes stated"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(TimeLapseReplay, RefusesADayFromAFrameThatCannotShowIt) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, true);
  const auto refusal = [&](const char* frame) {
    const RunResult run = RunPleinair({"replay", folder / "site", "-o", folder / "out",
                                       "--time-lapse", "day", "--time-lapse-frame", frame});
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    return run.err;
  };
  const cv::Mat blank(480, 640, CV_8UC3, cv::Scalar(90, 120, 150));
  cv::imwrite(folder / "site/frames/0001.jpg", blank);
  EXPECT_THAT(refusal("1"), HasSubstr("frame 1 has no pose"));
  // Reported before any processing: no code has read the bad model yet.
  WriteFile(folder / "site/object.obj", "v 0 0 0\n");
  EXPECT_THAT(refusal("2"), HasSubstr("frame 2 lies beyond the recording's 2"));
  EXPECT_THAT(refusal("1"), HasSubstr("object.obj"));
}

}  // namespace
}  // namespace pleinair::e2e
