#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/e2e/command_output.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Live, ARecordingMadeLiveReplaysToTheSameSightings) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 6, /*with_object=*/false);
  const std::string camera = "file:" + (folder / "site").string();
  const std::string take = (folder / "take").string();
  const RunResult live =
      RunPleinair({"live", "--camera", camera, "--headless", "--json", "--record", take});
  ASSERT_EQ(live.exit_code, 0) << live.err;
  const auto statistics = JsonLines(live.out).back();
  EXPECT_EQ(statistics.at("captured"), 6);
  EXPECT_EQ(statistics.at("recorded"), 6);
  ASSERT_EQ(RunPleinair({"live", "--camera", camera, "--headless", "--lossless", "--detections",
                         (folder / "one.jsonl").string()})
                .exit_code,
            0);
  ASSERT_EQ(RunPleinair({"live", "--camera", "file:" + take, "--headless", "--lossless",
                         "--detections", (folder / "other.jsonl").string()})
                .exit_code,
            0);
  const std::string one = ReadFile(folder / "one.jsonl");
  EXPECT_THAT(one, HasSubstr("\"markers\":[{"));
  // The recording's stamps are arrival times: they differ slightly from multiples of 1/30 s.
  const auto without_stamps = [](const std::string& lines) {
    std::string poses;
    for (std::size_t at = 0; at < lines.size();) {
      const std::size_t end = lines.find('\n', at);
      poses += nlohmann::json::parse(lines.substr(at, end - at)).at("markers").dump() + "\n";
      at = end + 1;
    }
    return poses;
  };
  EXPECT_EQ(without_stamps(ReadFile(folder / "other.jsonl")), without_stamps(one));
}

TEST(Live, ShowsTheShadowMapsPartitionsWhereAsked) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, /*with_object=*/true);
  const auto shown = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.begin(),
                {"live", "--camera", "file:" + (folder / "site").string(), "--headless",
                 "--lossless", "--light", "stated", "--screenshot", (folder / name).string()});
    EXPECT_EQ(RunPleinair(more).exit_code, 0);
    return cv::mean(cv::imread((folder / name).string()));
  };
  const cv::Scalar plain = shown("plain.png", {});
  const cv::Scalar tinted = shown("tinted.png", {"--shadow-debug"});
  // The two partitions' tints, red and green, reduce blue.
  EXPECT_LT(tinted[0], 0.8 * plain[0]);
  EXPECT_LT(tinted[0] / plain[0], tinted[1] / plain[1]);
}

TEST(Live, TakesTheLightThatTheUserGives) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, /*with_object=*/true);
  for (const char* name : {"site/frames/0000.jpg", "site/frames/0001.jpg"}) {
    // Out of focus, so that there is a camera look to match.
    cv::Mat picture = cv::imread(folder / name);
    cv::GaussianBlur(picture, picture, {}, 1.5);
    ASSERT_TRUE(cv::imwrite(folder / name, picture));
  }
  const auto shown = [&](std::vector<std::string> more) {
    const std::string picture = (folder / "picture.png").string();
    more.insert(more.begin(), {"live", "--camera", "file:" + (folder / "site").string(),
                               "--headless", "--lossless", "--screenshot", picture});
    const RunResult live = RunPleinair(more);
    EXPECT_EQ(live.exit_code, 0) << live.err;
    return cv::imread(picture);
  };
  const cv::Mat plain = shown({});
  const auto changed = [&](const std::vector<std::string>& more) {
    return cv::norm(shown(more), plain, cv::NORM_INF);
  };
  EXPECT_GT(changed({"--sun-to-sky", "0"}), 20.0);
  EXPECT_GT(changed({"--heading", "10"}), 20.0);
  EXPECT_GT(changed({"--look", "clean"}), 20.0);
  EXPECT_GT(changed({"--light-cache", folder / "cache", "--sky-division", "2", "--convergence",
                     "0.2", "--light-patches", "1000", "--hands"}),
            0.0);
  EXPECT_EQ(Listing(folder / "cache").size(), 1U);
  for (const std::vector<std::string>& refused :
       {std::vector<std::string>{"--sun-to-sky", "-1"}, {"--sky-division", "5"}}) {
    std::vector<std::string> call = {"live", "--headless", "--camera",
                                     "file:" + (folder / "site").string()};
    call.insert(call.end(), refused.begin(), refused.end());
    EXPECT_EQ(RunPleinair(call).exit_code, 2) << refused[0];
  }
}

/// Numbers of a TUM file's lines after the time, by time.
std::map<std::string, std::vector<double>> PosesOf(const std::filesystem::path& file) {
  std::map<std::string, std::vector<double>> poses;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    std::string time;
    words >> time;
    for (double number; words >> number;) poses[time].push_back(number);
  }
  return poses;
}

TEST(Live, TheReplayOfARecordingHasThePosesOfTheSessionThatMadeIt) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 6, /*with_object=*/false);
  const RunResult live =
      RunPleinair({"live", "--camera", "file:" + (folder / "site").string(), "--rate", "3",
                   "--headless", "--json", "--record", (folder / "take").string(), "-o",
                   (folder / "live").string(), "--export", "colmap,euroc,gltf,mcap"});
  ASSERT_EQ(live.exit_code, 0) << live.err;
  const auto statistics = JsonLines(live.out).back();
  const RunResult replay =
      RunPleinair({"replay", (folder / "take").string(), "-o", (folder / "replayed").string(),
                   "--no-video", "--export", "colmap,euroc,gltf,mcap"});
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  std::vector<std::string> replayed = Listing(folder / "replayed");
  std::erase_if(replayed, [](const std::string& name) { return name.starts_with("report."); });
  EXPECT_EQ(Listing(folder / "live"), replayed);
  // On a busy machine some frames are too late and have no pose. The next frame is then found
  // without a prediction.
  const bool none_late = statistics.at("late_for_tracking") == 0;
  if (none_late) {
    for (const char* file : {"poses/sg_17.tum", "poses/sg_17.csv", "detections.jsonl",
                             "colmap/images.txt", "colmap/cameras.txt", "camera.mcap"}) {
      EXPECT_EQ(ReadFile(folder / "live" / file), ReadFile(folder / "replayed" / file)) << file;
    }
  }
  const auto one = PosesOf(folder / "live" / "poses" / "sg_17.tum");
  const auto other = PosesOf(folder / "replayed" / "poses" / "sg_17.tum");
  EXPECT_EQ(other.size(), 6U);
  EXPECT_EQ(one.size(), statistics.at("with_pose"));
  ASSERT_FALSE(one.empty());
  for (const auto& [time, pose] : one) {
    ASSERT_TRUE(other.contains(time)) << time;
    for (std::size_t i = 0; i < pose.size(); ++i) {
      EXPECT_NEAR(pose[i], other.at(time)[i], none_late ? 0.0 : 2e-3) << time;
    }
  }
}

TEST(Live, AccountsForEveryFrameAndItsMemoryIntervalByInterval) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 6, /*with_object=*/false);
  const RunResult live =
      RunPleinair({"live", "--camera", "file:" + (folder / "site").string(), "--loop", "--rate",
                   "60", "--headless", "--seconds", "6", "--report-every", "1.5", "--json"});
  ASSERT_EQ(live.exit_code, 0) << live.err;
  std::vector<nlohmann::json> lines = JsonLines(live.out);
  const nlohmann::json all = lines.back();
  lines.pop_back();
  ASSERT_GE(lines.size(), 3U);
  std::int64_t captured = 0, told = 0;
  for (const nlohmann::json& interval : lines) {
    captured += interval.at("captured").get<std::int64_t>();
    for (const char* what : {"drawn", "late_for_tracking", "late_for_drawing"}) {
      told += interval.at(what).get<std::int64_t>();
    }
    EXPECT_EQ(interval.at("lost"), 0);
    EXPECT_LE(interval.at("on_the_way"), 5) << "queues of one frame are all there is";
    EXPECT_GT(interval.at("memory_mb"), 10.0);
  }
  EXPECT_GT(captured, 30);
  EXPECT_EQ(all.at("captured"), captured);
  EXPECT_EQ(captured, told + all.at("on_the_way_at_end").get<std::int64_t>());
  EXPECT_EQ(all.at("unaccounted"), 0);
  // A second of frames that are never released would need 74 MB.
  EXPECT_LT(lines.back().at("memory_mb").get<double>(),
            lines[1].at("memory_mb").get<double>() + 20.0);
}

TEST(Live, WithoutItsCameraItSaysSoAndEndsWhenItsTimeIsOver) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, /*with_object=*/false);
  std::filesystem::create_directory(folder / "mine");
  for (const char* take : {"take", "mine"}) {
    const RunResult live =
        RunPleinair({"live", "--camera", "v4l2:serial=no such camera", "--calibration",
                     (folder / "site" / "recording.json").string(), "--scene",
                     (folder / "site" / "scene.toml").string(), "--headless", "--seconds", "0.5",
                     "--record", (folder / take).string()});
    EXPECT_EQ(live.exit_code, 0) << live.err;
    EXPECT_THAT(live.err,
                HasSubstr("camera waiting: v4l2:serial=no such camera: there is no such"));
    EXPECT_THAT(live.err, HasSubstr("0 frames captured"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "take")) << "there was nothing to record";
  EXPECT_TRUE(std::filesystem::exists(folder / "mine")) << "it was there before";
}

TEST(Live, BadInputIsOneLineThatNamesItAndExitCodeTwo) {
  const TemporaryFolder folder;
  const std::string bundled = "file:" + BundledRecording().string();
  const std::string file = (folder / "file").string();
  WriteFile(file, "a file");
  const std::vector<std::pair<std::vector<std::string>, std::string>> calls = {
      {{"--camera", "video0"}, "video0"},
      {{"--camera", "v4l2:/dev/video77"}, "pleinair calibrate"},
      {{"--camera", "file:/nowhere"}, "/nowhere"},
      {{"--camera", "v4l2:/dev/video77", "--lossless"}, "--lossless"},
      {{"--camera", "v4l2:/dev/video77", "--loop"}, "--loop"},
      {{"--camera", bundled, "--time", "today"}, "today"},
      {{"--camera", bundled, "--format", "YUYV"}, "--format"},
      {{"--camera", bundled, "--hold-exposure", "0.01"}, "--hold-exposure"},
      {{"--camera", bundled, "--window", "640x480"}, "--window"},
      {{"--camera", bundled, "--lossless", "--sky-division", "2"}, "--sky-division"},
      {{"--camera", bundled, "--lossless", "--convergence", "0.05"}, "--convergence"},
      {{"--camera", bundled, "--light-cache", file}, "is no folder"},
      {{"--camera", bundled, "--response", "/nowhere.json"}, "/nowhere.json"},
      {{"--camera", bundled, "--screenshot", "/nowhere/it.png"}, "/nowhere"},
      {{"--camera", bundled, "--record", "/proc/none"}, "/proc/none"}};
  for (const auto& [arguments, named] : calls) {
    std::vector<std::string> call = {"live", "--headless"};
    call.insert(call.end(), arguments.begin(), arguments.end());
    const RunResult live = RunPleinair(call);
    EXPECT_EQ(live.exit_code, 2) << arguments[1];
    EXPECT_THAT(live.err, StartsWith("pleinair: "));
    EXPECT_THAT(live.err, HasSubstr(named));
    EXPECT_EQ(std::count(live.err.begin(), live.err.end(), '\n'), 1) << live.err;
  }
}

TEST(Devices, RunsWhereThereIsNoCamera) {
  const RunResult devices = RunPleinair({"devices", "--json"});
  EXPECT_EQ(devices.exit_code, 0) << devices.err;
  for (std::size_t at = 0; at < devices.out.size();) {
    const std::size_t end = devices.out.find('\n', at);
    EXPECT_TRUE(nlohmann::json::parse(devices.out.substr(at, end - at)).contains("uri"));
    at = end + 1;
  }
}

}  // namespace
}  // namespace pleinair::e2e
