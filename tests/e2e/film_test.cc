#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "base/srgb.h"
#include "devices/recordings/video_file.h"
#include "tests/devices/films/made_film.h"
#include "tests/devices/films/shown_frames.h"
#include "tests/e2e/run_program.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int kFrames = 3;

fs::path Site() { return tests::SourceTree() / "recordings/courtyard_midday"; }

/// The recording's frames, as a phone held upright stores them: turned counter-clockwise.
cv::Mat Stored(int i) {
  const fs::path file = Site() / ("frames/000" + std::to_string(i) + ".jpg");
  cv::Mat turned;
  cv::rotate(cv::imread(file.string()), turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  return turned;
}

/// A film of the recording's first frames, with a pause after the second, sound, place and date.
tests::MadeFilm PhoneFilm() {
  tests::MadeFilm film;
  film.width = 480;
  film.height = 640;
  film.ticks = {0, 1001, 9002};
  film.display = {0, 1, -1, 0};
  film.sound_encoder = "aac";
  film.sound_s = 0.3;
  film.tags = {{"com.apple.quicktime.location.ISO6709", "+50.0875+014.4213+220.0/"},
               {"com.apple.quicktime.creationdate", "2025-09-14T13:05:00+0200"}};
  film.muxer_options = {{"movflags", "use_metadata_tags"}};
  return film;
}

/// Y'CbCr of a stored frame, by a curve and a matrix of luma and primaries, limited range.
template <typename Signal>
void Draw(AVFrame* frame, int i, double kr, double kb, const std::array<double, 9>& primaries,
          int depth, const Signal& signal) {
  const cv::Mat bgr = Stored(i);
  cv::Mat planes[3];
  for (cv::Mat& plane : planes) plane = cv::Mat(bgr.size(), CV_64F);
  const double unit = 1 << (depth - 8);
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x) {
      const cv::Vec3b pixel = bgr.at<cv::Vec3b>(y, x);
      const double light[] = {LinearFromSrgb(pixel[2] / 255.0), LinearFromSrgb(pixel[1] / 255.0),
                              LinearFromSrgb(pixel[0] / 255.0)};
      double rgb[3];
      for (int c = 0; c < 3; ++c) {
        rgb[c] = signal(primaries[3 * c] * light[0] + primaries[3 * c + 1] * light[1] +
                        primaries[3 * c + 2] * light[2]);
      }
      const double luma = kr * rgb[0] + (1 - kr - kb) * rgb[1] + kb * rgb[2];
      planes[0].at<double>(y, x) = (219 * luma + 16) * unit;
      planes[1].at<double>(y, x) = (112 * (rgb[2] - luma) / (1 - kb) + 128) * unit;
      planes[2].at<double>(y, x) = (112 * (rgb[0] - luma) / (1 - kr) + 128) * unit;
    }
  }
  for (int p = 0; p < 3; ++p) {
    cv::Mat plane = planes[p];
    if (p > 0) cv::resize(plane, plane, {}, 0.5, 0.5, cv::INTER_AREA);
    for (int y = 0; y < plane.rows; ++y) {
      std::uint8_t* row = frame->data[p] + y * frame->linesize[p];
      for (int x = 0; x < plane.cols; ++x) {
        const auto code = static_cast<int>(std::lround(plane.at<double>(y, x)));
        if (depth == 8) row[x] = static_cast<std::uint8_t>(code);
        if (depth > 8) reinterpret_cast<std::uint16_t*>(row)[x] = static_cast<std::uint16_t>(code);
      }
    }
  }
}

constexpr std::array<double, 9> kSame{1, 0, 0, 0, 1, 0, 0, 0, 1};
// ITU-R BT.2087-0, Annex 1, M2.
constexpr std::array<double, 9> kBt2020{0.6274, 0.3293, 0.0433, 0.0691, 0.9195,
                                        0.0114, 0.0164, 0.0880, 0.8956};

/// ITU-R BT.2100-2, Table 5, with diffuse white at 75 %.
double Hlg(double light) {
  const double e = std::max(light, 0.0) * 0.264962560;
  return e <= 1.0 / 12.0 ? std::sqrt(3 * e)
                         : 0.17883277 * std::log(12 * e - 0.28466892) + 0.55991073;
}

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
  tests::MadeFilm film = PhoneFilm();
  film.transfer = 13;
  film.primaries = 1;
  film.matrix = 1;
  tests::WriteFilm(folder / "walk.mov", film, [](AVFrame* frame, int i) {
    Draw(frame, i, 0.2126, 0.0722, kSame, 8, [](double light) { return SrgbFromLinear(light); });
  });
  const RunResult described = RunPleinair({"film", folder / "walk.mov"});
  ASSERT_EQ(described.exit_code, 0) << described.err;
  EXPECT_THAT(described.out,
              AllOf(HasSubstr("640x480, turned by 90 degrees"), HasSubstr("sound: aac"),
                    HasSubstr("time = \"2025-09-14T13:05:00+02:00\""),
                    HasSubstr("latitude_deg = 50.087500")));
  const RunResult json = RunPleinair({"film", folder / "walk.mov", "--json"});
  EXPECT_EQ(nlohmann::json::parse(json.out)["frames"], kFrames);

  const RunResult run = Replay(folder / "walk.mov", folder / "out", {"--frames"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto composed = devices::OpenVideo(folder / "out/composite.mp4", {});
  ASSERT_TRUE(composed) << composed.error().Message();
  EXPECT_EQ(composed->facts.sound_codec, "aac");
  const auto frames = tests::ReadAll(*composed->frames);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_NEAR(static_cast<double>(frames[i].timestamp_ns),
                static_cast<double>(film.ticks[i]) / 30'000.0 * 1e9, 1e6);
  }
  const std::string poses = ReadFile(folder / "out/poses/sg_17.tum");
  EXPECT_THAT(poses, HasSubstr("0.300066"));

  // The same film in HLG.
  film.encoder = "libx265";
  film.pixels = "yuv420p10le";
  film.primaries = film.matrix = 9;
  film.transfer = 18;
  tests::WriteFilm(folder / "hdr.mov", film,
                   [](AVFrame* frame, int i) { Draw(frame, i, 0.2627, 0.0593, kBt2020, 10, Hlg); });
  const RunResult hdr = Replay(folder / "hdr.mov", folder / "hdr", {"--frames", "--no-video"});
  ASSERT_EQ(hdr.exit_code, 0) << hdr.err;
  for (int i = 0; i < kFrames; ++i) {
    const std::string name = "frames/000" + std::to_string(i) + ".png";
    // CIE 1976 weights saturated colors more than CIEDE2000 does; 4:2:0 at both ends costs most.
    EXPECT_LT(DeltaE(folder / "out" / name, folder / "hdr" / name), 1.2) << i;
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
