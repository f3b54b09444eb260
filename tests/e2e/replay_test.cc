#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "tests/e2e/command_output.h"
#include "tests/e2e/run_program.h"
#include "tests/e2e/tum_file.h"

namespace pleinair::e2e {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

TEST(Replay, WritesEveryOutputOfACompositeWithItsObject) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, true);
  const RunResult run = RunPleinair({"replay", folder / "site", "-o", folder / "deep/out",
                                     "--frames", "--json", "--export", "gltf,colmap,euroc,mcap"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(
      Listing(folder / "deep/out"),
      ElementsAre("camera.glb", "camera.mcap", "colmap", "colmap/cameras.txt", "colmap/images.txt",
                  "colmap/points3D.txt", "composite.mp4", "detections.jsonl", "frames",
                  "frames/0000.png", "frames/0001.png", "light.csv", "poses", "poses/sg_17.csv",
                  "poses/sg_17.tum", "report.html", "report.json"));
  EXPECT_THAT(ReadFile(folder / "deep/out/colmap/images.txt"), HasSubstr(" frames/0001.png\n"));
  const auto summary = nlohmann::json::parse(run.out);
  EXPECT_EQ(summary["frames"], 2);
  EXPECT_EQ(summary["frames_with_pose"], 2);
  const auto report = nlohmann::json::parse(ReadFile(folder / "deep/out/report.json"));
  EXPECT_NEAR(report["light"]["sun_elevation_deg"], 43.10, 0.01);
  EXPECT_NEAR(report["light"]["sun_azimuth_deg"], 182.46, 0.05);
  EXPECT_GT(report["timings"].size(), 4U);
  EXPECT_EQ(report["timings"].back()["stage"], "whole replay");
  EXPECT_EQ(summary["timings"], report["timings"]);
  const cv::Mat before = cv::imread(folder / "site/frames/0000.jpg");
  const cv::Mat after = cv::imread(folder / "deep/out/frames/0000.png");
  EXPECT_GT(cv::norm(before, after, cv::NORM_L1), 0.0);
  const std::string page = ReadFile(folder / "deep/out/report.html");
  EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64,"));
  EXPECT_THAT(page, Not(HasSubstr("http://")));
  EXPECT_THAT(page, Not(HasSubstr("https://")));
}

TEST(Replay, FindsTheHeadingThatTheSceneStatesWrongly) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, true);
  std::string scene = ReadFile(folder / "site/scene.toml");
  const std::size_t at = scene.find("heading_deg = 342");
  ASSERT_NE(at, std::string::npos);
  WriteFile(folder / "site/scene.toml", scene.replace(at, 17, "heading_deg = 345"));
  const RunResult run =
      RunPleinair({"replay", folder / "site", "-o", folder / "out", "--no-video"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("heading"));
  const auto report = nlohmann::json::parse(ReadFile(folder / "out/report.json"));
  const auto& light = report["light"]["measured"];
  EXPECT_NEAR(light["heading_offset_deg"], -3.0, 0.3);
  EXPECT_EQ(light["sun_shines"], true);
  // The sky's share of the light on level ground is 0.1752.
  EXPECT_NEAR(light["sun_to_sky"].get<double>() / (1 / 0.1752 - 1), 1.0, 0.15);
}

TEST(Replay, TakesTheLightThatTheUserGives) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  const RunResult run =
      RunPleinair({"replay", folder / "site", "-o", folder / "out", "--no-video", "--sun-to-sky",
                   "0", "--heading", "10", "--light-cache", folder / "cache", "--frames",
                   "--time-lapse", "11:00..13:00", "--every", "60min"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(Listing(folder / "out"),
              ElementsAre("detections.jsonl", "frames", "frames/0000.png", "light.csv", "poses",
                          "poses/sg_17.tum", "report.html", "report.json", "timelapse",
                          "timelapse.mp4", "timelapse.png", "timelapse/0000.png",
                          "timelapse/0001.png", "timelapse/0002.png"));
  EXPECT_THAT(ReadFile(folder / "out/report.html"), HasSubstr("data:video/mp4;base64,"));
  const auto report = nlohmann::json::parse(ReadFile(folder / "out/report.json"));
  EXPECT_EQ(report["light"]["sun_normal_lux"], 0.0);
  EXPECT_EQ(Listing(folder / "cache").size(), 1U);
  EXPECT_EQ(report["light"]["measured"]["sun_from"], "option");
  EXPECT_EQ(report["light"]["measured"]["heading_from"], "option");
  EXPECT_EQ(RunPleinair({"replay", folder / "site", "-o", folder / "out2", "--sun-to-sky", "-1"})
                .exit_code,
            2);
}

TEST(BenchReplay, TracesDaylightAsFinelyAndAsFarAsAsked) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  const auto traced = [&](const std::vector<std::string>& how) {
    std::vector<std::string> arguments = {
        "bench",         "replay",         folder / "site",   "-o",     folder / "out",
        "--no-video",    "--light",        "stated",          "--look", "clean",
        "--light-cache", folder / "cache", "--light-patches", "1000"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    std::filesystem::remove_all(folder / "cache");
    const RunResult run = RunPleinair(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto files = Listing(folder / "cache");
    EXPECT_EQ(files.size(), 1U);
    return files.empty() ? std::string() : ReadFile(folder / "cache" / files.front());
  };
  const std::string as_is = traced({});
  // One number per sky patch: 145 of Tregenza's, 577 of Reinhart's.
  EXPECT_GT(traced({"--sky-division", "2"}).size(), 3 * as_is.size());
  const std::string fewer_reflections = traced({"--convergence", "0.2"});
  EXPECT_EQ(fewer_reflections.size(), as_is.size());
  // After the file's header, in the light data.
  EXPECT_NE(fewer_reflections.substr(as_is.size() / 2), as_is.substr(as_is.size() / 2));
}

TEST(Replay, ShowsOnATerminalHowFarItIs) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  // A pseudo-terminal (util-linux).
  const std::string command = PleinairProgram() + " replay '" + (folder / "site").string() +
                              "' -o '" + (folder / "out").string() +
                              "' --no-video --light stated --light-cache '" +
                              (folder / "cache").string() + "'";
  const RunResult run = RunCommandLine({"script", "-qec", command, "/dev/null"});
  ASSERT_EQ(run.exit_code, 0) << run.out;
  for (const char* bar :
       {"Finding markers [...", "Tracing light [...", "Tracing light [#", "Composing [..."}) {
    EXPECT_THAT(run.out, HasSubstr(bar));
  }
}

TEST(Replay, ReportsThatTheLightChangedMeanwhile) {
  // The program compares medians of five consecutive estimates. Three of the second five are
  // darker.
  constexpr int kFrames = 8;
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", kFrames, true);
  const auto warning = [&](const char* changes) {
    const RunResult run =
        RunPleinair({"replay", folder / "site", "-o", folder / "out", "--no-video", "--light",
                     "stated", "--light-changes", changes});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.err;
  };
  EXPECT_THAT(warning("hold"), Not(HasSubstr("brightness changed")));
  // About half the light.
  for (int i = kFrames - 3; i < kFrames; ++i) {
    const std::string file = folder / fmt::format("site/frames/{:04}.jpg", i);
    const cv::Mat picture = cv::imread(file);
    ASSERT_FALSE(picture.empty());
    ASSERT_TRUE(cv::imwrite(file, picture * 0.73));
  }
  EXPECT_THAT(warning("hold"), HasSubstr("brightness changed by a factor of 2"));
  // Surfaces in sun and shade changed alike: it was the exposure, and nothing is wrong.
  EXPECT_THAT(warning("follow"), Not(HasSubstr("brightness changed")));
}

TEST(Replay, ReportsThatTheLightCouldNotBeKept) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  // /proc rejects new folders from every user, including root.
  const RunResult run = RunPleinair({"replay", folder / "site", "-o", folder / "out", "--no-video",
                                     "--light", "stated", "--light-cache", "/proc/pleinair"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("could not be written to /proc/pleinair"));
}

TEST(Replay, RecoversTheCamerasTruePathOfTheBundledRecording) {
  const TemporaryFolder folder;
  WriteFile(folder / "empty.toml", R"(time = "2025-09-14T11:05:00Z"
[place]
latitude_deg = 50.0875
longitude_deg = 14.4213
[marker]
size_m = 0.5
)");
  const RunResult run = RunPleinair({"replay", BundledRecording(), "--scene", folder / "empty.toml",
                                     "-o", folder / "out", "--no-video"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto truth = ReadTum(BundledRecording() / "truth.tum");
  const auto found = ReadTum(folder / "out/poses/sg_17.tum");
  ASSERT_EQ(found.size(), truth.size());
  std::vector<double> rotation_deg, position_share;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(found[i].time_s, truth[i].time_s, 1e-6);
    const PoseError error = ErrorOf(found[i], truth[i]);
    rotation_deg.push_back(error.rotation_deg);
    position_share.push_back(error.position_share);
  }
  for (const auto& [what, values] : {std::pair{"rotation, degrees", rotation_deg},
                                     {"position, share of the distance", position_share}}) {
    std::printf("%-32s median %.5f, 95 %% %.5f, largest %.5f\n", what, Percentile(values, 0.5),
                Percentile(values, 0.95), Percentile(values, 1.0));
  }
  // At least as accurate as with an AprilTag in the same place (docs/measurements/tracker.md).
  EXPECT_LT(Percentile(rotation_deg, 0.5), 0.012);
  EXPECT_LT(Percentile(rotation_deg, 1.0), 0.04);
  EXPECT_LT(Percentile(position_share, 0.5), 0.0002);
  EXPECT_LT(Percentile(position_share, 1.0), 0.0008);
}

TEST(Replay, WithoutAVirtualObjectKeepsEveryPixel) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 3, false);
  const RunResult run =
      RunPleinair({"replay", folder / "site", "-o", folder / "out", "--frames", "--no-video"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* name : {"0000", "0001", "0002"}) {
    const cv::Mat before = cv::imread(folder / ("site/frames/" + std::string(name) + ".jpg"));
    const cv::Mat after = cv::imread(folder / ("out/frames/" + std::string(name) + ".png"));
    ASSERT_EQ(before.size(), after.size());
    EXPECT_EQ(cv::norm(before, after, cv::NORM_INF), 0.0) << name;
  }
  EXPECT_THAT(Listing(folder / "out"), Not(Contains("composite.mp4")));
}

TEST(Replay, GivesTheSameBytesTwice) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, true);
  std::array<nlohmann::json, 2> reports;
  for (int i = 0; i < 2; ++i) {
    const std::string out = folder / ("out" + std::to_string(i));
    // One run on one processor: threads must not change the result either.
    const RunResult run = RunPleinair({"replay", folder / "site", "-o", out, "--frames"},
                                      i == 0 ? "" : "taskset -c 0");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    reports[i] = nlohmann::json::parse(ReadFile(out + "/report.json"));
    reports[i].erase("timings");
    reports[i].erase("command");  // Names the folder, which differs here.
  }
  EXPECT_EQ(reports[0], reports[1]);
  for (const std::string& name : Listing(folder / "out0")) {
    if (name.starts_with("report") || std::filesystem::is_directory(folder / ("out0/" + name))) {
      continue;
    }
    EXPECT_TRUE(ReadFile(folder / ("out0/" + name)) == ReadFile(folder / ("out1/" + name))) << name;
  }
}

TEST(Replay, ReplacesTheOutputsOfAnEarlierReplayAndNothingElse) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, false);
  ASSERT_EQ(RunPleinair({"replay", folder / "site", "-o", folder / "out", "--frames"}).exit_code,
            0);
  WriteFile(folder / "out/notes.txt", "mine");
  WriteFile(folder / "out/frames/mine.png", "mine");
  ASSERT_EQ(RunPleinair({"replay", folder / "site", "-o", folder / "out", "--no-video"}).exit_code,
            0);
  EXPECT_THAT(Listing(folder / "out"),
              ElementsAre("detections.jsonl", "frames", "frames/mine.png", "notes.txt", "poses",
                          "poses/sg_17.tum", "report.html", "report.json"));
  // A later frame alone, as the guide says after each change.
  for (int i = 0; i < 2; ++i) {
    const RunResult one =
        RunPleinair({"replay", folder / "site", "-o", folder / "one", "--frame", "1"});
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_THAT(Listing(folder / "one"), Contains("frames/0001.png"));
  }
  EXPECT_EQ(
      RunPleinair({"replay", folder / "site", "-o", folder / "one", "--frame", "0"}).exit_code, 0);
  EXPECT_THAT(Listing(folder / "one"), Not(Contains("frames/0001.png")));
  WriteFile(folder / "one/frames/0005.png", "mine");
  EXPECT_EQ(
      RunPleinair({"replay", folder / "site", "-o", folder / "one", "--frame", "0"}).exit_code, 2);
}

TEST(Replay, LeavesFramesWithoutAMarkerAsTheyAreAndSaysSo) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, true);
  const cv::Mat blank(480, 640, CV_8UC3, cv::Scalar(90, 120, 150));
  cv::imwrite(folder / "site/frames/0001.jpg", blank);
  const RunResult run =
      RunPleinair({"replay", folder / "site", "-o", folder / "out", "--frames", "--no-video"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("1 of 2 frames show no marker sg_17"));
  const cv::Mat before = cv::imread(folder / "site/frames/0001.jpg");
  const cv::Mat after = cv::imread(folder / "out/frames/0001.png");
  EXPECT_EQ(cv::norm(before, after, cv::NORM_INF), 0.0);
  const auto frames = JsonLines(ReadFile(folder / "out/detections.jsonl"));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].at("markers").size(), 1U);
  EXPECT_EQ(frames[1].at("markers").size(), 0U);
}

TEST(Replay, ReportsThatWithoutPhantomsNothingTakesTheShadow) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  std::string scene = ReadFile(folder / "site/scene.toml");
  const std::string phantom = "[[phantom]]\nfile = \"phantom.obj\"\n";
  scene.erase(scene.find(phantom), phantom.size());
  WriteFile(folder / "site/scene.toml", "ground = false\n" + scene);
  const RunResult run =
      RunPleinair({"replay", folder / "site", "-o", folder / "out", "--frames", "--no-video"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("no phantom: the objects cast no shadow on real surfaces"));
  // Without a word about the ground, it is level, and the object's shadow falls on it.
  WriteFile(folder / "site/scene.toml", scene);
  const RunResult on_ground =
      RunPleinair({"replay", folder / "site", "-o", folder / "ground", "--frames", "--no-video"});
  ASSERT_EQ(on_ground.exit_code, 0) << on_ground.err;
  EXPECT_THAT(on_ground.err, HasSubstr("level ground in the marker's plane is assumed"));
  const cv::Mat floating = cv::imread(folder / "out/frames/0000.png", cv::IMREAD_GRAYSCALE);
  const cv::Mat standing = cv::imread(folder / "ground/frames/0000.png", cv::IMREAD_GRAYSCALE);
  cv::Mat darker = floating - standing;  // Clipped at zero.
  EXPECT_GT(cv::countNonZero(darker > 20), 300);
}

TEST(Replay, NamesOddFoldersOnOneLineAndRepeatsItsCommandAsAShellTakesIt) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "my site", 1, false);
  const RunResult run =
      RunPleinair({"bench", "replay", folder / "my site", "-o", folder / "a\nb", "--no-video",
                   "--shadow-partitions", "1", "--shader-dir", folder.path()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("a b: detections.jsonl"));
  const auto report = nlohmann::json::parse(ReadFile(folder / "a\nb/report.json"));
  const std::string at = folder.path().string();
  EXPECT_EQ(report["command"], "pleinair bench replay '" + at + "/my site' -o '" + at +
                                   "/a\nb' --shadow-partitions 1 --shader-dir " + at +
                                   " --no-video");
}

TEST(Replay, ResizesTheOutput) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, true);
  const RunResult run = RunPleinair(
      {"replay", folder / "site", "-o", folder / "out", "--frames", "--size", "321x241"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(cv::imread(folder / "out/frames/0000.png").size(), cv::Size(321, 241));
  EXPECT_THAT(run.err, HasSubstr("H.264 needs even sizes"));
}

TEST(Command, WithoutASubcommandPrintsItsHelpAndFails) {
  const RunResult run = RunPleinair({});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("replay"));
  EXPECT_THAT(run.err, HasSubstr("Examples:"));
  EXPECT_THAT(run.out, IsEmpty());
}

TEST(Command, HelpOfEverySubcommandHasExamples) {
  for (const char* subcommand : {"replay", "detect", "sun", "doctor"}) {
    const RunResult run = RunPleinair({subcommand, "--help"});
    EXPECT_EQ(run.exit_code, 0) << subcommand;
    EXPECT_THAT(run.out, HasSubstr("pleinair " + std::string(subcommand))) << subcommand;
  }
}

TEST(Command, ReportsItsVersion) {
  const RunResult run = RunPleinair({"--version"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, StartsWith("pleinair "));
}

TEST(Command, FailsWhereItsResultCannotBePrinted) {
  const RunResult run = RunCommandLine({"sh", "-c", PleinairProgram() + " --help >/dev/full"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("No space left on device"));
}

}  // namespace
}  // namespace pleinair::e2e
