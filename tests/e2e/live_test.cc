#include <gmock/gmock.h>

#include <string>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "run_program.h"

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
  const auto statistics = nlohmann::json::parse(live.out);
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
  // The recording's stamps are those of the moments when the frames came: a hair beside 1/30 s.
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
  // Red and green, the two partitions' tints, leave less of blue.
  EXPECT_LT(tinted[0], 0.8 * plain[0]);
  EXPECT_LT(tinted[0] / plain[0], tinted[1] / plain[1]);
}

TEST(Live, WithoutItsCameraItSaysSoAndEndsWhenItsTimeIsOver) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, /*with_object=*/false);
  const RunResult live =
      RunPleinair({"live", "--camera", "v4l2:serial=no such camera", "--calibration",
                   (folder / "site" / "recording.json").string(), "--scene",
                   (folder / "site" / "scene.toml").string(), "--headless", "--seconds", "0.5"});
  EXPECT_EQ(live.exit_code, 0) << live.err;
  EXPECT_THAT(live.err, HasSubstr("camera waiting: v4l2:serial=no such camera: there is no such"));
  EXPECT_THAT(live.err, HasSubstr("0 frames captured"));
}

TEST(Live, BadInputIsOneLineAndExitCodeTwo) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> calls = {
      {"--camera", "video0", "--headless"},
      {"--camera", "v4l2:/dev/video77", "--headless"},
      {"--camera", "file:/nowhere", "--headless"},
      {"--camera", "v4l2:/dev/video77", "--headless", "--lossless"},
      {"--camera", "file:" + BundledRecording().string(), "--headless", "--time", "today"}};
  for (const std::vector<std::string>& arguments : calls) {
    std::vector<std::string> call = {"live"};
    call.insert(call.end(), arguments.begin(), arguments.end());
    const RunResult live = RunPleinair(call);
    EXPECT_EQ(live.exit_code, 2) << arguments[1];
    EXPECT_THAT(live.err, StartsWith("pleinair: "));
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
