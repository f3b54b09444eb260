// Runs inside the VM, on the kernel's own drivers: docs/measurements/capture.md lists the
// behaviours.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string_view>
#include <thread>
#include <utility>

#include "devices/recordings/recording.h"
#include "tests/source_tree.h"
#include "tests/vm/camera_helpers.h"
#include "tests/vm/courtyard_film.h"
#include "tests/vm/uvc_simulator.h"

namespace pleinair::vm {
namespace {

using devices::PixelFormat;

/// A grey image after conversion from the camera's limited-range Y.
GreyImage ThroughYuyv(const GreyImage& grey) {
  devices::RawImage raw;
  raw.format = PixelFormat::kYuyv;
  raw.width = grey.width();
  raw.height = grey.height();
  raw.stride = static_cast<std::size_t>(grey.width()) * 2;
  for (std::size_t i = 0; i < grey.size(); ++i) {
    raw.bytes.push_back(grey.data()[i]);
    raw.bytes.push_back(128);
  }
  devices::DecodedImage image;
  EXPECT_TRUE(ConvertRawImage(raw, &image));
  return image.grey;
}

constexpr const char* kSequence = "/tmp/sequence.grey";

/// Writes the simulator's images and returns the expected received images.
std::vector<GreyImage> WriteSequence(const CourtyardFilm& film) {
  std::vector<GreyImage> sent;
  std::ofstream bytes(kSequence, std::ios::binary);
  for (const GreyImage& grey : film.pictures) {
    bytes.write(reinterpret_cast<const char*>(grey.data()),
                static_cast<std::streamsize>(grey.size()));
    sent.push_back(ThroughYuyv(grey));
  }
  return sent;
}

/// Parameter: backend of the camera.
class Behaviour12 : public testing::TestWithParam<const char*> {};

TEST_P(Behaviour12, WhatIsRecordedLiveReplaysToIdenticalPosesAndTheseAreRight) {
  const CourtyardFilm film = OpenCourtyardFilm();
  const std::vector<GreyImage> sent = WriteSequence(film);
  const UvcSimulator simulator({"--fps", "5", "--grey", kSequence, "640", "480"});
  const auto camera = Open(Options(GetParam(), PixelFormat::kYuyv, 640, 480));
  ASSERT_TRUE(camera);
  ExpectRightPosesAndTheSameInReplay(camera.get(), film, sent);
}

INSTANTIATE_TEST_SUITE_P(V4l2, Behaviour12, testing::Values(kUsb));
#ifdef PLEINAIR_HAS_LIBCAMERA
INSTANTIATE_TEST_SUITE_P(Libcamera, Behaviour12, testing::Values("libcamera:0"));
#endif

/// `pleinair` as a separate process, with its output in a file.
class Command {
 public:
  Command(const char* printed, std::vector<std::string> arguments) {
    const char* program = std::getenv("PLEINAIR");
    const int output = open(printed, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (program == nullptr || output < 0) std::abort();  // As where the simulator is not there.
    arguments.insert(arguments.begin(), program);
    std::vector<char*> details;
    for (std::string& argument : arguments) details.push_back(argument.data());
    details.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      // Other threads may have held locks: only calls that are safe in handlers of signals.
      if (dup2(output, STDOUT_FILENO) >= 0) execv(details[0], details.data());
      _exit(127);
    }
    close(output);
  }
  ~Command() {
    if (pid_ > 0) kill(pid_, SIGKILL);
    Wait();
  }
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  void Terminate() const {
    if (pid_ > 0) kill(pid_, SIGTERM);
  }
  /// For its exit code; -1 where a signal ended it.
  int Wait() {
    int status = 0;
    if (pid_ <= 0 || waitpid(std::exchange(pid_, -1), &status, 0) < 0) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_ = -1;
};

/// The camera's places in the marker's frame with its turn, by the time as it is written.
std::map<std::string, std::vector<double>> PathOf(const std::string& file) {
  std::map<std::string, std::vector<double>> path;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream details(line);
    std::string time;
    if (line.starts_with('#') || !(details >> time)) continue;
    for (double number = 0.0; details >> number;) path[time].push_back(number);
  }
  return path;
}

/// Frames that a session's accounts tell of as tracked.
int TrackedOf(const char* accounts) {
  int tracked = 0;
  std::ifstream in(accounts);
  constexpr std::string_view kName = "\"tracked\":";
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find(kName);
    if (at != std::string::npos) tracked += std::atoi(line.c_str() + at + kName.size());
  }
  return tracked;
}

TEST(LiveCommand, TracksAndRecordsACameraUntilItIsEndedAndReplaysToTheSamePoses) {
  const std::string source = tests::SourceTree() / "recordings/courtyard_tag36h11";
  const CourtyardFilm film = OpenCourtyardFilm();
  const std::vector<GreyImage> sent = WriteSequence(film);
  std::ofstream("/tmp/scene.toml") << R"(time = "2025-09-14T11:05:00Z"
[place]
latitude_deg = 50.0875
longitude_deg = 14.4213
[marker]
family = "tag36h11"
size_m = 0.48
heading_deg = 342
)";
  {
    // Slowly: all of this machine is software.
    const UvcSimulator simulator({"--fps", "1", "--grey", kSequence, "640", "480"});
    Command live("/tmp/live.jsonl",
                 {"live", "--camera", kUsb, "--format", "YUYV", "--calibration",
                  source + "/recording.json", "--scene", "/tmp/scene.toml", "--headless",
                  "--record", "/tmp/take", "-o", "/tmp/lived", "--json", "--report-every", "0.5"});
    // Only ever waited out by a failing test.
    for (int i = 0; i < 600 && TrackedOf("/tmp/live.jsonl") < 3; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    live.Terminate();
    ASSERT_EQ(live.Wait(), 0);
  }
  ASSERT_EQ(
      Command("/dev/null", {"replay", "/tmp/take", "-o", "/tmp/replayed", "--no-video"}).Wait(), 0);
  const auto lived = PathOf("/tmp/lived/poses/tag36h11_0.tum");
  const auto replayed = PathOf("/tmp/replayed/poses/tag36h11_0.tum");
  auto take = devices::OpenRecording("/tmp/take");
  ASSERT_TRUE(take) << take.error().Message();
  EXPECT_EQ(take->frames->FrameCount(), replayed.size()) << "every frame has a pose";
  ASSERT_GE(lived.size(), 3U);
  // Of the frame after one that came too late to be tracked the last digits may differ.
  const bool none_late = lived.size() == replayed.size();
  std::cout << lived.size() << " tracked live of " << replayed.size() << " recorded\n";
  for (const auto& [time, pose] : replayed) {
    const auto frame = take->frames->Next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_NEAR(static_cast<double>((*frame)->timestamp_ns) * 1e-9, std::stod(time), 2e-6);
    const std::size_t number = NumberOf((*frame)->grey, sent);
    ASSERT_LT(number, sent.size()) << "none of those that were sent";
    ASSERT_EQ(pose.size(), 7U);
    const Vec3 place{pose[0], pose[1], pose[2]};
    EXPECT_LT(Norm(place - film.places[number]), 0.005);
    const auto live_pose = lived.find(time);
    if (live_pose == lived.end()) continue;
    for (std::size_t i = 0; i < pose.size(); ++i) {
      EXPECT_NEAR(live_pose->second[i], pose[i], none_late ? 0.0 : 2e-3);
    }
  }
}

}  // namespace
}  // namespace pleinair::vm
