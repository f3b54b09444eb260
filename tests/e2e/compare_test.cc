#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "run_program.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// The untouched background in place of a composite.
void CopyBackgrounds(const fs::path& folder) {
  fs::create_directories(folder);
  for (const char* name : {"0036", "0072"}) {
    fs::copy_file(BundledRecording() / "key" / (std::string(name) + "_background.png"),
                  folder / (std::string(name) + ".png"));
  }
}

TEST(Compare, ScoresUntouchedBackgroundsAsTheRecordingsOwnScoresDo) {
  const TemporaryFolder folder;
  CopyBackgrounds(folder / "out");
  const RunResult run = RunPleinair(
      {"compare", folder / "out", BundledRecording(), "--json", "--report", folder / "page.html"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  // From score.py of the rendered recordings (NumPy and OpenCV), version of 2026-11.
  const auto& first = json["pictures"]["0036"];
  const std::map<std::string, double> expected{
      {"PSNR", 23.6764},    {"SSIM", 0.9572},   {"dE_obj", 21.5449},    {"dE_shadow", 24.0063},
      {"dE_near", 10.1748}, {"dE_all", 1.8592}, {"PSNR_near", 15.4465}, {"SSIM_near", 0.7261}};
  for (const auto& [name, value] : expected) {
    EXPECT_NEAR(first[name].get<double>() / value, 1.0, 0.002) << name;
  }
  const std::string page = ReadFile(folder / "page.html");
  EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64,"));
  EXPECT_THAT(page, Not(HasSubstr("http")));
}

TEST(Compare, TakesPlainFoldersOfPictures) {
  const TemporaryFolder folder;
  CopyBackgrounds(folder / "a");
  const RunResult run = RunPleinair({"compare", folder / "a", folder / "a", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["mean"]["dE_all"], 0.0);
  EXPECT_TRUE(json["mean"]["dE_obj"].is_null());
}

TEST(Compare, RefusesWhatItCannotCompare) {
  const TemporaryFolder folder;
  CopyBackgrounds(folder / "out");
  fs::remove(folder / "out/0072.png");
  const RunResult missing =
      RunPleinair({"compare", folder / "out", BundledRecording(), "--report", folder / "p.html"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("0072.png"));
  EXPECT_FALSE(fs::exists(folder / "p.html"));
  EXPECT_EQ(RunPleinair({"compare", folder / "out", folder / "nowhere"}).exit_code, 2);
  fs::create_directories(folder / "bad");
  WriteFile(folder / "bad/scene.json", "{\"key_frames\": [{}");
  EXPECT_EQ(RunPleinair({"compare", folder / "out", folder / "bad"}).exit_code, 2);
}

}  // namespace
}  // namespace pleinair::e2e
