// Tests `pleinair replay --time-lapse` as a process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "tests/e2e/run_program.h"

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
