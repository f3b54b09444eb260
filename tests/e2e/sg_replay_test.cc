// Tests replays of recordings with an S-G marker: named or not, lost, mirrored.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/e2e/command_output.h"
#include "tests/e2e/run_program.h"
#include "tests/e2e/tum_file.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The first frames of the bundled recording, with its scene.json changed by `edit`, without
/// object.
template <typename Edit>
void MakeRecording(const fs::path& folder, int frames, Edit edit) {
  MakeShortRecording(folder, frames, false);
  fs::remove(folder / "scene.toml");
  json scene = json::parse(ReadFile(BundledRecording() / "scene.json"));
  scene["image"]["frame_count"] = frames;
  scene.erase("virtual_object");
  edit(scene);
  WriteFile(folder / "scene.json", scene.dump());
}

RunResult Replay(const TemporaryFolder& folder) {
  return RunPleinair({"replay", folder / "site", "-o", folder / "out", "--no-video"});
}

json Report(const TemporaryFolder& folder) {
  return json::parse(ReadFile(folder / "out/report.json"));
}

std::vector<json> Detections(const TemporaryFolder& folder) {
  return JsonLines(ReadFile(folder / "out/detections.jsonl"));
}

/// Reduces the description of the marker to what remains true of a replacement.
void LeaveUnnamed(json& scene) {
  json& marker = scene["marker"];
  for (const char* key : {"family", "id", "version"}) marker.erase(key);
  marker["what"] = "swapped in: marker.png";
}

TEST(SgReplay, FindsTheMarkerThatTheSceneDoesNotName) {
  const TemporaryFolder folder;
  MakeRecording(folder / "site", 2, LeaveUnnamed);
  // The family is absent too.
  json recording = json::parse(ReadFile(folder / "site/recording.json"));
  ASSERT_FALSE(recording["marker"].contains("family"));
  const RunResult run = Replay(folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("2 of 2 frames have a pose (marker sg_17)"));
  const json report = Report(folder);
  EXPECT_EQ(report["marker"], "sg_17");
  EXPECT_EQ(report["markers_seen"], json::array({"sg_17"}));
  EXPECT_EQ(report["poses"]["found_by"], json::parse(R"({"fast":1,"surf-golay":0,"tracked":1})"));
  const std::vector<json> detections = Detections(folder);
  ASSERT_EQ(detections.size(), 2U);
  const json& marker = detections[1]["markers"][0];
  EXPECT_EQ(marker["path"], "tracked");
  EXPECT_GT(marker["visible_fraction"], 0.95);
}

TEST(SgReplay, FindsAnAprilTagThatTheSceneDoesNotName) {
  const TemporaryFolder folder;
  const fs::path bundled = tests::SourceTree() / "recordings/courtyard_tag36h11";
  fs::copy(bundled, folder / "site", fs::copy_options::recursive);
  json scene = json::parse(ReadFile(bundled / "scene.json"));
  LeaveUnnamed(scene);
  scene.erase("virtual_object");
  scene.erase("real_geometry");
  WriteFile(folder / "site/scene.json", scene.dump());
  const RunResult run = Replay(folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("6 of 6 frames have a pose (marker tag36h11_0)"));
  const auto truth = ReadTum(bundled / "truth.tum");
  const auto found = ReadTum(folder / "out/poses/tag36h11_0.tum");
  ASSERT_EQ(truth.size(), 6U);
  ASSERT_EQ(found.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(ErrorOf(found[i], truth[i]).rotation_deg, 0.1) << i;
    EXPECT_LT(ErrorOf(found[i], truth[i]).position_share, 0.002) << i;
  }
}

TEST(SgReplay, LooksOnlyForTheNumberThatTheSceneNames) {
  const TemporaryFolder folder;
  MakeRecording(folder / "site", 1, [](json& scene) { scene["marker"]["id"] = 18; });
  const RunResult run = Replay(folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("(sg_18) was seen in no frame"));
  EXPECT_THAT(run.err, HasSubstr("only number 18 was searched for"));
  EXPECT_TRUE(Report(folder)["marker"].is_null());
}

TEST(SgReplay, ReportsSinceWhenAMarkerIsLost) {
  const TemporaryFolder folder;
  MakeRecording(folder / "site", 4, [](json&) {});
  const cv::Mat blank(480, 640, CV_8UC3, cv::Scalar(90, 120, 150));
  for (const char* name : {"0001", "0002"}) {
    cv::imwrite(folder / ("site/frames/" + std::string(name) + ".jpg"), blank);
  }
  const RunResult run = Replay(folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<json> detections = Detections(folder);
  ASSERT_EQ(detections.size(), 4U);
  EXPECT_THAT(detections[0]["lost"], IsEmpty());
  for (const int frame : {1, 2}) {
    ASSERT_EQ(detections[frame]["lost"].size(), 1U);
    EXPECT_EQ(detections[frame]["lost"][0]["family"], "sg");
    EXPECT_EQ(detections[frame]["lost"][0]["id"], 17);
    EXPECT_EQ(detections[frame]["lost"][0]["frames"], frame);
  }
  EXPECT_THAT(detections[3]["lost"], IsEmpty());
  EXPECT_EQ(Report(folder)["poses"]["lost"], json::parse(R"({"frames":2,"longest":2})"));
}

TEST(SgReplay, ReportsThatTheMarkerIsMirrored) {
  const TemporaryFolder folder;
  MakeRecording(folder / "site", 3, LeaveUnnamed);
  for (const char* name : {"0000", "0001", "0002"}) {
    const std::string file = folder / ("site/frames/" + std::string(name) + ".jpg");
    cv::Mat mirrored;
    cv::flip(cv::imread(file), mirrored, 1);
    cv::imwrite(file, mirrored, {cv::IMWRITE_JPEG_QUALITY, 95});
  }
  const RunResult run = Replay(folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("In 3 frames, the first being 0, a marker that looks like number "
                                 "17 is printed mirrored"));
  EXPECT_EQ(Report(folder)["frames_with_pose"], 0);
}

}  // namespace
}  // namespace pleinair::e2e
