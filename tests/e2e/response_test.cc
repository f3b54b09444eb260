#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/e2e/run_program.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

/// The bundled recording with an AprilTag, which shows surfaces of known color in sun and in shade.
fs::path CopyOfTagRecording(const TemporaryFolder& folder) {
  const fs::path bundled = tests::SourceTree() / "recordings";
  fs::copy(bundled / "courtyard_tag36h11", folder / "courtyard_tag36h11",
           fs::copy_options::recursive);
  fs::create_directories(folder / "courtyard_midday");
  for (const char* model : {"phantom.obj", "phantom.mtl", "object.obj", "object.mtl"}) {
    fs::copy_file(bundled / "courtyard_midday" / model, folder / "courtyard_midday" / model);
  }
  return folder / "courtyard_tag36h11";
}

/// A picture style of more contrast, over sRGB.
double Contrast(double code) { return 0.5 * code + 0.5 * code * code * (3 - 2 * code); }

/// Darker by a third, so that nothing clips.
void FilmWithMoreContrast(const fs::path& recording) {
  cv::Mat table(1, 256, CV_8U);
  for (int code = 0; code < 256; ++code) {
    table.at<std::uint8_t>(code) =
        static_cast<std::uint8_t>(std::lround(255 * Contrast(0.8 * code / 255)));
  }
  for (const auto& frame : fs::directory_iterator(recording / "frames")) {
    cv::Mat image = cv::imread(frame.path().string());
    cv::LUT(image, table, image);
    cv::imwrite(frame.path().string(), image, {cv::IMWRITE_JPEG_QUALITY, 95});
  }
}

json Json(const std::string& text) { return json::parse(text, nullptr, false); }

TEST(Response, HoldsSrgbWhereTheFramesDoNotContradictIt) {
  const TemporaryFolder folder;
  const fs::path recording = CopyOfTagRecording(folder);
  const RunResult run =
      RunPleinair({"response", recording, "-o", folder / "camera.response", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(Json(run.out)["response"], "srgb");
  EXPECT_LT(Json(run.out)["evidence_log"], 0.0);
  EXPECT_EQ(Json(ReadFile(folder / "camera.response"))["response"], "srgb");
  const RunResult text = RunPleinair({"response", recording});
  EXPECT_THAT(text.out, HasSubstr("sRGB holds."));
}

TEST(Response, IsEstimatedAndUsedByReplayUnlessItIsGiven) {
  const TemporaryFolder folder;
  const fs::path recording = CopyOfTagRecording(folder);
  FilmWithMoreContrast(recording);
  const RunResult run =
      RunPleinair({"response", recording, "-o", folder / "camera.response", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(Json(run.out)["response"], "measured");
  const double error = Json(run.out)["light_relative_error"];
  const json curve = Json(ReadFile(folder / "camera.response"));
  ASSERT_TRUE(curve.contains("green"));
  // Light beside a bright one, at pixel values that the frames show.
  const auto light = [&](std::size_t i) { return curve["green"][i].get<double>(); };
  for (std::size_t i = 15; i < 40; i += 5) {
    const auto srgb = [](double code) { return std::pow((code + 0.055) / 1.055, 2.4); };
    const auto truth = [&](double code) {
      double before = code;  // Inverse of Contrast() by fixed-point steps.
      for (int k = 0; k < 100; ++k) before += 0.5 * (code - Contrast(before));
      return srgb(before);
    };
    const double at = curve["encoded"][i], bright = curve["encoded"][40];
    const double off = std::log(light(i) / light(40)) - std::log(truth(at) / truth(bright));
    EXPECT_LT(std::fabs(off), 3 * error) << at;
  }
  const auto replay = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"replay", recording, "-o", folder / "out", "--no-video"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult replayed = RunPleinair(arguments);
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    const json report = Json(ReadFile(folder / "out/report.json"));
    const std::string from = report["light"]["camera_response"]["from"];
    EXPECT_EQ(replayed.err.find("does not encode light as sRGB") != std::string::npos,
              from == "measured");
    return from;
  };
  EXPECT_EQ(replay({}), "measured");
  EXPECT_EQ(replay({"--response", folder / "camera.response"}), "stated");
  EXPECT_EQ(replay({"--response", "srgb"}), "stated");
}

TEST(Response, IsRefusedWithTheReasonAndNothingIsWritten) {
  const TemporaryFolder folder;
  const auto refusal = [&](const fs::path& recording) {
    const RunResult run = RunPleinair({"response", recording, "-o", folder / "camera.response"});
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_FALSE(fs::exists(folder / "camera.response"));
    return run.err;
  };
  MakeShortRecording(folder / "bright", 2, true);
  for (const char* frame : {"bright/frames/0000.jpg", "bright/frames/0001.jpg"}) {
    // The marker's white is clipped.
    cv::imwrite(folder / frame, cv::imread(folder / frame) * 1.3);
  }
  EXPECT_THAT(refusal(folder / "bright"), HasSubstr("does not show the camera's response"));
  MakeShortRecording(folder / "empty", 1, false);
  EXPECT_THAT(refusal(folder / "empty"), HasSubstr("has no virtual object"));
  EXPECT_THAT(refusal(folder / "nowhere"), HasSubstr("nowhere"));
  const RunResult full =
      RunPleinair({"response", CopyOfTagRecording(folder), "-o", folder / "no/camera.response"});
  EXPECT_NE(full.exit_code, 0);
  EXPECT_THAT(full.err, HasSubstr("no/camera.response"));
}

}  // namespace
}  // namespace pleinair::e2e
