// Tests the replay of a recording whose scene has a picture target in place of a marker.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/poster.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"
#include "tests/e2e/tum_file.h"

namespace pleinair::e2e {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kWidth_m = 0.84;  // Covers the recording's own marker with its white margin.

constexpr const char* kScene = R"(time = "2025-09-14T11:05:00Z"
cloudiness = "clear"
[place]
latitude_deg = 50.0875
longitude_deg = 14.4213
[marker]
target = "poster.target"
heading_deg = 342
[[phantom]]
file = "phantom.obj"
[[object]]
file = "object.obj"
)";

/// The first frames of the bundled recording with a poster over the marker, and the true camera
/// poses.
std::vector<TumPose> MakePosterRecording(const std::filesystem::path& folder, int frames) {
  MakeShortRecording(folder, frames, true);
  const cv::Mat poster = Poster(1);
  cv::imwrite(folder / "poster.png", poster);
  WriteFile(folder / "scene.toml", kScene);
  std::vector<TumPose> truth = ReadTum(BundledRecording() / "truth.tum");
  for (int i = 0; i < frames; ++i) {
    const std::string file = folder / fmt::format("frames/{:04}.jpg", i);
    cv::Mat frame = cv::imread(file);
    PastePoster(poster, kWidth_m, truth[i].marker_from_camera.Inverse(), &frame);
    cv::imwrite(file, frame, {cv::IMWRITE_JPEG_QUALITY, 95});
  }
  return truth;
}

/// Draws over a frame.
template <typename Draw>
void Cover(const std::filesystem::path& file, Draw draw) {
  cv::Mat frame = cv::imread(file);
  draw(frame);
  cv::imwrite(file, frame, {cv::IMWRITE_JPEG_QUALITY, 95});
}

TEST(TargetReplay, FollowsAPictureAndComposesOnItThroughCoversAndLoss) {
  const TemporaryFolder folder;
  const std::vector<TumPose> truth = MakePosterRecording(folder / "site", 8);
  // A bar over two fifths of the poster in frames 3 and 4; in frame 5 the whole poster is hidden.
  for (const int i : {3, 4}) {
    Cover(folder / fmt::format("site/frames/{:04}.jpg", i), [](cv::Mat& frame) {
      cv::rectangle(frame, {330, 0}, {420, 479}, {90, 120, 190}, cv::FILLED);
    });
  }
  Cover(folder / "site/frames/0005.jpg",
        [](cv::Mat& frame) { frame.setTo(cv::Scalar(90, 120, 150)); });
  ASSERT_EQ(RunPleinair({"target", folder / "site/poster.png", "--width-mm", "840", "-o",
                         folder / "site/poster.target"})
                .exit_code,
            0);
  const RunResult run =
      RunPleinair({"replay", folder / "site", "-o", folder / "out", "--no-video", "--frames"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("7 of 8 frames have a pose (marker picture_0)"));
  const std::vector<TumPose> found = ReadTum(folder / "out/poses/picture_0.tum");
  ASSERT_EQ(found.size(), 7U);
  for (const TumPose& pose : found) {
    const TumPose* true_pose = PoseAt(truth, pose.time_s);
    ASSERT_NE(true_pose, nullptr);
    EXPECT_LT(ErrorOf(pose, *true_pose).rotation_deg, 0.2) << pose.time_s;
    EXPECT_LT(ErrorOf(pose, *true_pose).position_share, 0.003) << pose.time_s;
  }
  const std::vector<json> frames = JsonLines(ReadFile(folder / "out/detections.jsonl"));
  ASSERT_EQ(frames.size(), 8U);
  EXPECT_EQ(frames[0]["markers"][0]["path"], "surf-golay");
  EXPECT_EQ(frames[1]["markers"][0]["path"], "tracked");
  EXPECT_EQ(frames[1]["markers"][0]["name"], "poster");
  EXPECT_GT(frames[1]["markers"][0]["visible_fraction"], 0.95);
  // The coverage mask contains the bar: covered blocks, and visible ones elsewhere.
  const json& covered = frames[4]["markers"][0];
  EXPECT_LT(covered["visible_fraction"], 0.8);
  EXPECT_GT(covered["visible_fraction"], 0.4);
  int hidden = 0, seen = 0;
  for (const double part : covered["visibility"]["values"]) (part < 0.3 ? hidden : seen) += 1;
  EXPECT_GT(hidden, seen / 4);
  EXPECT_EQ(frames[5]["lost"], json::parse(R"([{"family":"picture","id":0,"name":"poster",
                                               "frames":1}])"));
  EXPECT_THAT(frames[6]["lost"], IsEmpty());
  // The object stands on the poster. Frames without a pose are unchanged.
  const auto difference = [&](int i) {
    const cv::Mat before = cv::imread(folder / fmt::format("site/frames/{:04}.jpg", i));
    return cv::norm(before, cv::imread(folder / fmt::format("out/frames/{:04}.png", i)),
                    cv::NORM_L1);
  };
  EXPECT_GT(difference(2), 100'000.0);
  EXPECT_EQ(difference(5), 0.0);
}

TEST(TargetReplay, RefusesAScenesTargetThatCannotBe) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, false);
  struct Case {
    const char *marker, *message;
  };
  for (const Case& c : {
           Case{"target = \"none.target\"", "none.target, which is not there"},
           Case{"target = \"phantom.obj\"", "phantom.obj: "},
           Case{"target = \"\"", "without a name"},
           Case{"target = \"phantom.obj\"\nsize_mm = 100", "keep marker.target alone"},
           Case{"target = \"phantom.obj\"\nid = 3", "keep marker.target alone"},
           Case{"target = 3", "scene.toml:7: \"target\" is not a text"},
           Case{"family = \"picture\"\nsize_mm = 100", "does not name it"},
       }) {
    WriteFile(folder / "site/scene.toml", std::string("time = \"2025-09-14T11:05:00Z\"\n"
                                                      "[place]\nlatitude_deg = 50\n"
                                                      "longitude_deg = 14\n"
                                                      "[marker]\nheading_deg = 342\n") +
                                              c.marker + "\n");
    const RunResult run = RunPleinair({"replay", folder / "site", "-o", folder / "out"});
    ExpectRefused(run, c.message);
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << c.marker;
  }
}

}  // namespace
}  // namespace pleinair::e2e
