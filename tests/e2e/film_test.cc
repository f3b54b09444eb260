#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "devices/recordings/video_file.h"
#include "tests/devices/films/shown_frames.h"
#include "tests/e2e/phone_film.h"
#include "tests/e2e/run_program.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

fs::path Site() { return tests::SourceTree() / "recordings/courtyard_midday"; }

RunResult Replay(const fs::path& film, const fs::path& out, std::vector<std::string> options) {
  std::vector<std::string> arguments{
      "replay", film, "--calibration", Site() / "recording.json", "--scene", Site() / "scene.json",
      "-o",     out};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return RunPleinair(arguments);
}

/// Mean difference of two images in CIELAB (CIE 1976).
double DeltaE(const fs::path& a, const fs::path& b) {
  cv::Mat lab[2];
  int i = 0;
  for (const fs::path& file : {a, b}) {
    cv::Mat image = cv::imread(file.string());
    image.convertTo(image, CV_32F, 1.0 / 255.0);
    cv::cvtColor(image, lab[i++], cv::COLOR_BGR2Lab);
  }
  cv::Mat difference = lab[0] - lab[1], squares;
  cv::multiply(difference, difference, squares);
  std::vector<cv::Mat> channels;
  cv::split(squares, channels);
  cv::Mat delta;
  cv::sqrt(channels[0] + channels[1] + channels[2], delta);
  return cv::mean(delta)[0];
}

TEST(Film, OfAPhoneIsDescribedAndComposedWithItsTimesAndSound) {
  const TemporaryFolder folder;
  WritePhoneFilm(folder / "walk.mov");
  const RunResult described = RunPleinair({"film", folder / "walk.mov"});
  ASSERT_EQ(described.exit_code, 0) << described.err;
  EXPECT_THAT(described.out,
              AllOf(HasSubstr("640x480, turned by 90 degrees"), HasSubstr("sound: aac"),
                    HasSubstr("time = \"2025-09-14T13:05:00+02:00\""),
                    HasSubstr("latitude_deg = 50.087500")));
  const RunResult json = RunPleinair({"film", folder / "walk.mov", "--json"});
  EXPECT_EQ(nlohmann::json::parse(json.out)["frames"], kPhoneFrames);

  const RunResult run = Replay(folder / "walk.mov", folder / "out", {"--frames"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto composed = devices::OpenVideo(folder / "out/composite.mp4", {});
  ASSERT_TRUE(composed) << composed.error().Message();
  EXPECT_EQ(composed->facts.sound_codec, "aac");
  const auto frames = tests::ReadAll(*composed->frames);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kPhoneFrames));
  const std::vector<std::int64_t> ticks = PhoneFilm().ticks;
  for (int i = 0; i < kPhoneFrames; ++i) {
    EXPECT_NEAR(static_cast<double>(frames[i].timestamp_ns),
                static_cast<double>(ticks[i]) / 30'000.0 * 1e9, 1e6);
  }
  const std::string poses = ReadFile(folder / "out/poses/sg_17.tum");
  EXPECT_THAT(poses, HasSubstr("0.300066"));

  // The same film in HLG.
  WriteHlgPhoneFilm(folder / "hdr.mov");
  const RunResult hdr = Replay(folder / "hdr.mov", folder / "hdr", {"--frames", "--no-video"});
  ASSERT_EQ(hdr.exit_code, 0) << hdr.err;
  // CIEDE2000; most of it comes from 4:2:0 in two encodings.
  const RunResult compared =
      RunPleinair({"compare", folder / "hdr/frames", folder / "out/frames", "--json"});
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  const nlohmann::json pictures = nlohmann::json::parse(compared.out)["pictures"];
  EXPECT_EQ(pictures.size(), static_cast<std::size_t>(kPhoneFrames));
  for (const auto& [name, scores] : pictures.items()) {
    std::printf("HLG against SDR, frame %s: CIEDE2000 %.2f\n", name.c_str(),
                scores["dE_all"].get<double>());
    EXPECT_LT(scores["dE_all"].get<double>(), 1.0) << name;
  }
}

TEST(Film, OnePictureOfItIsMadeAlone) {
  const TemporaryFolder folder;
  const RunResult one = RunPleinair({"replay", Site(), "--frame", "2", "-o", folder / "one"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_TRUE(fs::exists(folder / "one/frames/0002.png"));
  EXPECT_FALSE(fs::exists(folder / "one/frames/0001.png"));
  EXPECT_FALSE(fs::exists(folder / "one/composite.mp4"));
  const RunResult still = Replay(Site() / "frames/0002.jpg", folder / "still", {});
  ASSERT_EQ(still.exit_code, 0) << still.err;
  // The scene's time is that of the still, 2/15 s earlier in the recording: nothing to be seen.
  EXPECT_LT(DeltaE(folder / "one/frames/0002.png", folder / "still/frames/0000.png"), 0.1);
}

TEST(Film, RangesWithoutFramesAndOtherFilesAreRefused) {
  const TemporaryFolder folder;
  const auto refusal = [&](std::vector<std::string> arguments) {
    const RunResult run = RunPleinair(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(fs::exists(folder / "out"));
    return run.err;
  };
  const std::string site = Site(), out = folder / "out";
  EXPECT_THAT(refusal({"replay", site, "-o", out, "--frame", "90"}),
              HasSubstr("has no frame 90: it has 90"));
  EXPECT_THAT(refusal({"replay", site, "-o", out, "--from", "60"}), HasSubstr("from 60 s"));
  EXPECT_THAT(refusal({"replay", site, "-o", out, "--from", "3", "--to", "2"}),
              HasSubstr("is after --to"));
  EXPECT_THAT(refusal({"replay", site, "-o", out, "--frame", "1", "--to", "2"}),
              HasSubstr("--frame"));
  WriteFile(folder / "words.mov", "no film");
  EXPECT_THAT(refusal({"film", folder / "words.mov"}),
              AllOf(StartsWith("pleinair: "), HasSubstr("words.mov")));
  EXPECT_THAT(refusal({"film", folder / "none.mov"}), HasSubstr("none.mov"));
}

}  // namespace
}  // namespace pleinair::e2e
