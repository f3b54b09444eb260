#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// The unchanged background in place of a composite.
void CopyBackgrounds(const fs::path& folder) {
  fs::create_directories(folder);
  for (const char* name : {"0036", "0072"}) {
    fs::copy_file(BundledRecording() / "key" / (std::string(name) + "_background.png"),
                  folder / (std::string(name) + ".png"));
  }
}

/// The first JPEG with a caption in an HTML page.
cv::Mat PictureIn(const std::string& page, const std::string& caption) {
  const std::string head = "alt=\"" + caption + "\"", data = "data:image/jpeg;base64,";
  const std::size_t at = page.find(data, page.find(head));
  if (page.find(head) == std::string::npos || at == std::string::npos) return {};
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (std::size_t i = at + data.size(); page[i] != '"' && page[i] != '='; ++i) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    bits = bits << 6U | static_cast<std::uint32_t>(kDigits.find(page[i]));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> static_cast<unsigned>(count)));
  }
  return cv::imdecode(bytes, cv::IMREAD_COLOR);
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
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_THAT(page, Not(HasSubstr("<video"))) << "no day was drawn";
  // Black where there is no error, bright where the object is missing.
  const cv::Mat difference = PictureIn(page, "difference");
  ASSERT_FALSE(difference.empty());
  cv::Mat mask = cv::imread(BundledRecording() / "key/0036_objmask.png", cv::IMREAD_GRAYSCALE);
  cv::resize(mask, mask, difference.size(), 0, 0, cv::INTER_AREA);
  EXPECT_GT(cv::mean(difference, mask == 255)[2], 200.0);
  EXPECT_LT(cv::mean(difference(cv::Rect(0, 0, 80, 80)))[2], 5.0);
  EXPECT_EQ(PictureIn(page, "truth").size(), difference.size());
  EXPECT_EQ(PictureIn(page, "composed").size(), difference.size());
}

TEST(Compare, ShowsTheDayOfTheScene) {
  const TemporaryFolder folder;
  CopyBackgrounds(folder / "out");
  WriteFile(folder / "out/timelapse.mp4", "video");
  WriteFile(folder / "out/timelapse.png", "sheet");
  const RunResult run = RunPleinair(
      {"compare", folder / "out", BundledRecording(), "--report", folder / "page.html"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string page = ReadFile(folder / "page.html");
  EXPECT_THAT(page, HasSubstr("<video controls autoplay loop muted"));
  EXPECT_THAT(page, HasSubstr("data:video/mp4;base64,dmlkZW8="));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,c2hlZXQ="));
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
