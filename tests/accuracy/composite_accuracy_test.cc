// Compares the composite of the bundled recording with a path-traced image of the same scene that
// contains the object.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "app/compare/ciede2000.h"
#include "base/srgb.h"
#include "tests/accuracy/key_frame.h"
#include "tests/e2e/run_program.h"

namespace pleinair::accuracy {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// The frames for which the recording has a ground-truth image.
constexpr std::array<int, 2> kKeyFrames{36, 72};

/// Pattern of the frames' file names; "{:04}" is the frame number.
constexpr const char* kJpegFrames = "frames/{:04}.jpg";
constexpr const char* kLosslessFrames = "key/{:04}_background.png";

/// Some of the recording's frames with a scene that a user could describe. It contains no ground
/// truth that the program could read.
void MakeRecordingWithoutTruth(const fs::path& folder, std::span<const int> frames,
                               const char* pictures) {
  const fs::path bundled = e2e::BundledRecording();
  fs::create_directories(folder / "frames");
  for (const char* name : {"phantom.obj", "phantom.mtl", "object.obj", "object.mtl"}) {
    fs::copy_file(bundled / name, folder / name);
  }
  json recording = json::parse(e2e::ReadFile(bundled / "recording.json"));
  json stamps = json::array();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const fs::path from = bundled / fmt::format(fmt::runtime(pictures), frames[i]);
    fs::copy_file(from, folder / fmt::format("frames/{:04}{}", i, from.extension().string()));
    stamps.push_back(recording["timestamps_s"][frames[i]]);
  }
  recording["timestamps_s"] = stamps;
  recording["frame_count"] = frames.size();
  recording.erase("truth");
  e2e::WriteFile(folder / "recording.json", recording.dump());

  const json all = json::parse(e2e::ReadFile(bundled / "scene.json"));
  json scene;
  for (const char* key : {"name", "format", "image", "intrinsics", "marker", "place_time"}) {
    scene[key] = all.at(key);
  }
  scene["sky"]["clouds"] = all.at("sky").at("clouds");
  scene["real_geometry"]["file"] = all.at("real_geometry").at("file");
  scene["virtual_object"]["file"] = all.at("virtual_object").at("file");
  scene["virtual_object"]["shading"] = all.at("virtual_object").at("shading");
  e2e::WriteFile(folder / "scene.json", scene.dump());
}

/// The object in its own color, as if the light were uniform.
cv::Mat PastedUnlit(const KeyFrame& key) {
  const json scene = json::parse(e2e::ReadFile(e2e::BundledRecording() / "scene.json"));
  const json& albedo = scene["virtual_object"]["albedo_linear_rec709"];
  cv::Mat pasted = key.background.clone();
  for (int y = 0; y < pasted.rows; ++y) {
    for (int x = 0; x < pasted.cols; ++x) {
      const double share = key.object_mask.at<std::uint8_t>(y, x) / 255.0;
      cv::Vec3b& pixel = pasted.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) {
        const double paint = Srgb8FromLinear(albedo[2 - c].get<double>());
        pixel[c] = cv::saturate_cast<std::uint8_t>(std::lerp(pixel[c], paint, share));
      }
    }
  }
  return pasted;
}

/// The best possible composite into the recording's JPEG frames.
cv::Mat ThroughJpeg(const cv::Mat& picture) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  return cv::imdecode(bytes, cv::IMREAD_COLOR);
}

struct Row {
  std::string name;
  std::vector<Score> scores;  ///< One per key frame.
  Score Mean() const {
    Score mean;
    for (const Score& score : scores) {
      mean.object += score.object / static_cast<double>(scores.size());
      mean.shadow += score.shadow / static_cast<double>(scores.size());
      mean.around += score.around / static_cast<double>(scores.size());
    }
    return mean;
  }
};

void Print(const std::vector<Row>& rows) {
  fmt::print(
      "\ncourtyard_midday, mean CIEDE2000 against the truth: object / shadow / both with 25 pixels "
      "around\n{:24}",
      "");
  for (const int frame : kKeyFrames) fmt::print("   frame {:04}         ", frame);
  fmt::print("   mean\n");
  for (const Row& row : rows) {
    fmt::print("{:24}", row.name);
    for (const Score& score : row.scores)
      fmt::print("{:5.2f} /{:5.2f} /{:5.2f}  ", score.object, score.shadow, score.around);
    const Score mean = row.Mean();
    fmt::print("{:5.2f} /{:5.2f} /{:5.2f}\n", mean.object, mean.shadow, mean.around);
  }
  std::fflush(stdout);
}

class CompositeOfCourtyardMidday : public testing::Test {
 protected:
  /// Scores of the program's composites of the key frames. A failure shortens the list.
  Row Replay(const std::string& name, const char* pictures) const {
    const e2e::TemporaryFolder folder;
    MakeRecordingWithoutTruth(folder / "site", kKeyFrames, pictures);
    const e2e::RunResult run = e2e::RunPleinair(
        {"replay", folder / "site", "-o", folder / "out", "--frames", "--no-video"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    Row row{name, {}};
    for (std::size_t i = 0; i < kKeyFrames.size(); ++i) {
      const cv::Mat picture = cv::imread(folder / fmt::format("out/frames/{:04}.png", i));
      const KeyFrame key = ReadKeyFrame(kKeyFrames[i]);
      EXPECT_EQ(picture.size(), key.truth.size());
      if (picture.size() == key.truth.size()) row.scores.push_back(Compare(picture, key));
    }
    return row;
  }
};

TEST_F(CompositeOfCourtyardMidday, LooksLikeThePathTracedTruth) {
  const Row ours = Replay("pleinair, JPEG frames", kJpegFrames);
  const Row lossless = Replay("pleinair, PNG frames", kLosslessFrames);
  Row untouched{"background untouched", {}}, unlit{"object pasted unlit", {}};
  Row floor{"truth through JPEG", {}};
  for (const int frame : kKeyFrames) {
    const KeyFrame key = ReadKeyFrame(frame);
    untouched.scores.push_back(Compare(key.background, key));
    unlit.scores.push_back(Compare(PastedUnlit(key), key));
    floor.scores.push_back(Compare(ThroughJpeg(key.truth), key));
  }
  ASSERT_EQ(ours.scores.size(), kKeyFrames.size());
  ASSERT_EQ(lossless.scores.size(), kKeyFrames.size());
  Print({ours, lossless, untouched, unlit, floor});
  for (const Score& score : ours.scores) {
    EXPECT_LE(score.object, 1.3);
    EXPECT_LE(score.shadow, 1.8);
    EXPECT_LE(score.around, 1.6);
  }
  for (const Score& score : lossless.scores) {
    EXPECT_LE(score.object, 1.3);
    EXPECT_LE(score.shadow, 1.4);
    EXPECT_LE(score.around, 1.0);
  }
  // For comparison of magnitudes.
  EXPECT_GT(untouched.Mean().object, 10.0);
  EXPECT_GT(untouched.Mean().shadow, 10.0);
  EXPECT_GT(unlit.Mean().object, 10.0);
}

/// Mean color of an image over level regions of the scene, [x, y] in marker coordinates.
app::Lab MeanColor(const cv::Mat& picture, const json& camera, const json& pose,
                   const std::vector<std::array<double, 2>>& places) {
  std::array<double, 3> sum{};
  const json& r = pose["rotation"];
  const json& t = pose["translation_m"];
  for (const auto& [x, y] : places) {
    std::array<double, 3> at{};
    for (int row = 0; row < 3; ++row) {
      at[row] =
          r[3 * row].get<double>() * x + r[3 * row + 1].get<double>() * y + t[row].get<double>();
    }
    const double u = camera["fx"].get<double>() * at[0] / at[2] + camera["cx"].get<double>();
    const double v = camera["fy"].get<double>() * at[1] / at[2] + camera["cy"].get<double>();
    const cv::Vec3b& bgr =
        picture.at<cv::Vec3b>(static_cast<int>(std::lround(v)), static_cast<int>(std::lround(u)));
    for (int c = 0; c < 3; ++c) sum[c] += LinearFromSrgb(bgr[2 - c] / 255.0);
  }
  const auto code = [&](int c) {
    return Srgb8FromLinear(sum[c] / static_cast<double>(places.size()));
  };
  return app::LabFromSrgb8({code(0), code(1), code(2)});
}

TEST_F(CompositeOfCourtyardMidday, ShowsWhitePaperBesideTheMarkersWhiteAsWhiteAsThat) {
  const e2e::TemporaryFolder folder;
  MakeRecordingWithoutTruth(folder / "site", kKeyFrames, kJpegFrames);
  const json scene = json::parse(e2e::ReadFile(folder / "site/scene.json"));
  const double white = scene["marker"]["albedo_white"];
  // A sheet as large as a hand, left of the white margin, in the marker's white.
  e2e::WriteFile(folder / "site/object.obj",
                 "mtllib object.mtl\nusemtl paper\nv -0.50 -0.2 0.003\nv -0.32 -0.2 0.003\n"
                 "v -0.32 0.2 0.003\nv -0.50 0.2 0.003\nf 1 2 3 4\n");
  e2e::WriteFile(folder / "site/object.mtl",
                 fmt::format("newmtl paper\nKd {0} {0} {0}\nillum 1\n", white));
  const e2e::RunResult run =
      e2e::RunPleinair({"replay", folder / "site", "-o", folder / "out", "--frames", "--no-video"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::vector<std::array<double, 2>> paper, print;
  for (double y = -0.17; y < 0.175; y += 0.02) {
    for (const double x : {-0.46, -0.43, -0.40, -0.37}) paper.push_back({x, y});
    for (const double x : {-0.28, -0.275, -0.27}) print.push_back({x, y});
  }
  std::istringstream lines(e2e::ReadFile(folder / "out/detections.jsonl"));
  std::string line;
  for (std::size_t i = 0; i < kKeyFrames.size(); ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    const json pose = json::parse(line)["markers"].at(0)["camera_from_marker"];
    const cv::Mat picture = cv::imread(folder / fmt::format("out/frames/{:04}.png", i));
    ASSERT_FALSE(picture.empty());
    const app::Lab ours = MeanColor(picture, scene["intrinsics"], pose, paper);
    const app::Lab printed = MeanColor(picture, scene["intrinsics"], pose, print);
    const double difference = app::Ciede2000(ours, printed);
    fmt::print("frame {:04}: white paper beside the marker's white, CIEDE2000 {:.2f}\n",
               kKeyFrames[i], difference);
    EXPECT_LT(difference, 3.0);
    // The sheet is visible: the paving under it is far from white.
    const cv::Mat before = cv::imread(folder / fmt::format("site/frames/{:04}.jpg", i));
    EXPECT_GT(app::Ciede2000(MeanColor(before, scene["intrinsics"], pose, paper), printed), 10.0);
  }
}

// A real pole stands right of the object and its shadow. Light could leak at its outline.
TEST_F(CompositeOfCourtyardMidday, KeepsWhatStandsFarFromTheObject) {
  const e2e::TemporaryFolder folder;
  MakeRecordingWithoutTruth(folder / "site", std::array{0}, kJpegFrames);
  const e2e::RunResult run =
      e2e::RunPleinair({"replay", folder / "site", "-o", folder / "out", "--frames", "--no-video"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const cv::Mat before = cv::imread(folder / "site/frames/0000.jpg");
  const cv::Mat after = cv::imread(folder / "out/frames/0000.png");
  ASSERT_EQ(before.size(), after.size());
  const cv::Range rows = cv::Range::all(), columns(500, before.cols);
  EXPECT_LE(cv::norm(before(rows, columns), after(rows, columns), cv::NORM_INF), 8.0);
}

}  // namespace
}  // namespace pleinair::accuracy
