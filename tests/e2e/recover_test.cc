// 'pleinair recover': what is whole of a damaged live recording.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "devices/recordings/frame_pack.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A live recording of four frames, with its description.
void MakeLiveRecording(const fs::path& folder) {
  fs::create_directory(folder);
  WriteFile(folder / "recording.json", R"({"frames": "frames.pack"})");
  WriteFile(folder / "scene.toml", "# mine\n");
  const auto writer = devices::FramePackWriter::Create(folder / "frames.pack");
  ASSERT_TRUE(writer);
  for (int i = 0; i < 4; ++i) {
    devices::Frame frame;
    frame.index = i;
    frame.timestamp_ns = i * 40'000'000LL;
    frame.rgb = RgbImage(16, 8, 3);
    std::fill_n(frame.rgb.data(), frame.rgb.size(), static_cast<std::uint8_t>(40 * i));
    ASSERT_TRUE((*writer)->Add(frame));
  }
}

TEST(Recover, CopiesTheRecordingWithItsWholeFrames) {
  const TemporaryFolder folder;
  MakeLiveRecording(folder / "walk");
  std::string pack = ReadFile(folder / "walk/frames.pack");
  const std::size_t frame = (pack.size() - 16) / 4;
  pack[16 + frame + 40] ^= 1;
  WriteFile(folder / "walk/frames.pack", pack);
  const RunResult run = RunPleinair({"recover", folder / "walk", "-o", folder / "clean", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["frames"], 3);
  ASSERT_EQ(json["lost"].size(), 1U);
  EXPECT_THAT(json["lost"][0].get<std::string>(), HasSubstr("before frame 1 are damaged"));
  EXPECT_THAT(Listing(folder / "clean"),
              ElementsAre("frames.pack", "recording.json", "scene.toml"));
  EXPECT_EQ(ReadFile(folder / "walk/frames.pack"), pack);  // The recording stays as it is.
  const auto clean = devices::OpenFramePack(folder / "clean/frames.pack", {});
  ASSERT_TRUE(clean);
  EXPECT_EQ(clean->frames->FrameCount(), 3);
  EXPECT_TRUE(clean->damage->empty());
}

TEST(Recover, ReplacesNothing) {
  const TemporaryFolder folder;
  MakeLiveRecording(folder / "walk");
  fs::create_directory(folder / "there");
  WriteFile(folder / "there/mine", "x");
  const auto recover = [&](const char* output) {
    return RunPleinair({"recover", folder / "walk", "-o", folder / output});
  };
  ExpectRefused(recover("there"), "is not empty");
  ExpectRefused(recover("walk"), "is not empty");
  ExpectRefused(recover("walk/clean"), "lies inside the recording");
  EXPECT_THAT(Listing(folder / "there"), ElementsAre("mine"));
}

TEST(Recover, InterruptedDuringTheSearchLeavesNothing) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "walk");
  WriteFile(folder / "walk/frames.pack", "pleinair frames\n");
  // Zeros without room on the disk, whose search takes many seconds.
  fs::resize_file(folder / "walk/frames.pack", std::uintmax_t{1} << 37);
  const std::string out = folder / "clean";
  // After it has begun to write, or after a timeout.
  const RunResult run = RunCommandLine(
      {"sh", "-c",
       PleinairProgram() + " recover '" + std::string(folder / "walk") + "' -o '" + out +
           "' & n=0; until ls -d '" + out +
           "'/.pleinair.part* >/dev/null 2>&1 || [ $((n += 1)) -gt 5000 ]; do :; done; "
           "kill -INT $!; wait $!"});
  ExpectRefused(run, "interrupted", 1);
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace pleinair::e2e
