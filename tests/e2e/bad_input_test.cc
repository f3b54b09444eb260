#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void Replace(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = ReadFile(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from << " is not in " << file;
  WriteFile(file, text.replace(at, from.size(), to));
}

/// A fault in a good recording, and what the one-line error must name.
struct Fault {
  const char* name;
  std::function<void(const fs::path& site)> plant;
  std::string message;
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

class BadRecording : public ::testing::TestWithParam<Fault> {};

TEST_P(BadRecording, IsRefusedInOneLineAndLeavesNothing) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, true);
  GetParam().plant(folder / "site");
  ExpectRefused(RunPleinair({"replay", folder / "site", "-o", folder / "a/out"}),
                GetParam().message);
  EXPECT_FALSE(fs::exists(folder / "a"));
}

INSTANTIATE_TEST_SUITE_P(
    Replay, BadRecording,
    ::testing::Values(
        Fault{"MissingFrame", [](const fs::path& site) { fs::remove(site / "frames/0001.jpg"); },
              "frames"},
        Fault{"FrameCutShort",
              [](const fs::path& site) {
                fs::remove(site / "frames/0001.jpg");
                fs::copy_file(
                    tests::SourceTree() / "recordings/courtyard_midday/key/0036_background.png",
                    site / "frames/0001.png");
                fs::resize_file(site / "frames/0001.png", 20000);
              },
              "0001"},
        Fault{"JsonCutShort",
              [](const fs::path& site) { fs::resize_file(site / "recording.json", 200); },
              "recording.json"},
        Fault{"ModelNotThere", [](const fs::path& site) { fs::remove(site / "object.obj"); },
              "object.obj"},
        Fault{"NanFocalLength",
              [](const fs::path& site) {
                Replace(site / "recording.json", "\"fx\": 605", "\"fx\": NaN");
              },
              "recording.json"},
        Fault{"ZeroFocalLength",
              [](const fs::path& site) {
                Replace(site / "recording.json", "\"fx\": 605", "\"fx\": 0");
              },
              "fx"},
        Fault{"RateThatNoVideoHas",
              [](const fs::path& site) {
                Replace(site / "recording.json", "\"frame_rate_hz\": 15",
                        "\"frame_rate_hz\": 1e-7");
              },
              "site: has 1e-07 frames a second, which no video can have"},
        Fault{"MarkerOfSizeZero",
              [](const fs::path& site) {
                Replace(site / "scene.toml", "\nsize_m = 0.5", "\nsize_m = 0");
              },
              "size_m"},
        Fault{"UnknownMarkerFamily",
              [](const fs::path& site) {
                Replace(site / "scene.toml", "\"sg\"", "\"tag99h9\"");
                fs::remove(site / "object.obj");  // The marker is searched for first.
                WriteFile(site / "object.obj", "no model");
              },
              "scene.toml: unknown marker family \"tag99h9\"; known are sg, tag36h11, "},
        Fault{"MarkerNumberThatDoesNotExist",
              [](const fs::path& site) {
                Replace(site / "scene.toml", "\"sg\"", "\"sg\"\nid = 4096");
              },
              "scene.toml: there is no marker number 4096; use numbers from 0 to 4095"},
        Fault{"MarkerVersionOfTheFuture",
              [](const fs::path& site) {
                Replace(site / "scene.toml", "\"sg\"", "\"sg\"\nversion = 2");
              },
              "scene.toml: has an S-G marker of version 2; this program reads version 1"},
        Fault{"FramesBeyondTheLastYear",
              [](const fs::path& site) {
                Replace(site / "scene.toml", "2025-09-14T11:05:00Z", "2261-12-31T23:59:50Z");
                Replace(site / "recording.json", "0.066667", "20000000");
              },
              "frame 1 lies beyond the years 1678 to 2261"},
        Fault{"TimeWithoutOffset",
              [](const fs::path& site) { Replace(site / "scene.toml", ":00Z", ":00"); },
              "2025-09-14"},
        Fault{
            "UnknownKey",
            [](const fs::path& site) { Replace(site / "scene.toml", "cloudiness", "cloudyness"); },
            "scene.toml:2"},
        Fault{"ObjIndexOutOfRange",
              [](const fs::path& site) {
                WriteFile(site / "object.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
              },
              "object.obj"},
        Fault{"HugeTexture",
              [](const fs::path& site) {
                // A PNG header of size 100000 x 100000 pixels.
                std::string png(
                    "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\x01\x86\xa0\0\x01\x86\xa0\x08\x02"
                    "\0\0\0\x92\x35\x7f\x0b",
                    33);
                WriteFile(site / "huge.png", png);
                WriteFile(site / "huge.mtl", "newmtl a\nmap_Kd huge.png\n");
                WriteFile(site / "object.obj",
                          "mtllib huge.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\n"
                          "vt 0 1\nf 1/1 2/2 3/3\n");
              },
              "huge.png: the texture is 100000 × 100000 pixels"}),
    [](const auto& fault) { return std::string(fault.param.name); });

TEST(BadInput, AMissingRecordingIsNamed) {
  const TemporaryFolder folder;
  const RunResult run = RunPleinair({"replay", folder / "none", "-o", folder / "out"});
  ExpectRefused(run, "none: does not exist");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(BadInput, AVideoCutShortIsRefused) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, false);
  ASSERT_EQ(RunPleinair({"replay", folder / "site", "-o", folder / "video"}).exit_code, 0);
  const fs::path video = folder / "video/composite.mp4";
  fs::resize_file(video, fs::file_size(video) / 2);
  const RunResult run =
      RunPleinair({"replay", video, "--calibration", folder / "site/recording.json", "--scene",
                   folder / "site/scene.toml", "-o", folder / "out"});
  ExpectRefused(run, "composite.mp4");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(BadInput, UsageErrorsPointToTheHelp) {
  ExpectRefused(RunPleinair({"replay"}), "pleinair replay --help");
  ExpectRefused(RunPleinair({"fly"}), "pleinair --help");
  ExpectRefused(RunPleinair({"replay", "x", "-o", "y", "--size", "big"}), "1280x720");
}

TEST(BadInput, GroupsOfCommandsShowTheirOwnExamples) {
  for (const char* group : {"path", "report", "bench"}) {
    const RunResult help = RunPleinair({group, "--help"});
    EXPECT_THAT(help.out, HasSubstr(std::string("  pleinair ") + group + " "));
    EXPECT_THAT(help.out, testing::Not(HasSubstr("pleinair doctor")));
  }
}

TEST(BadInput, TablesThatNeverEndAreRefused) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  ExpectRefused(RunPleinair({"sun", "--csv", "/dev/zero"}), "/dev/zero: is a device, not a file");
  ExpectRefused(RunPleinair({"sky", "--sun", "180,30", "--csv", "/dev/zero"}),
                "/dev/zero: is a device, not a file");
  ExpectRefused(RunPleinair({"sun", "--csv", folder / "pipe"}), "pipe: is a pipe, not a file");
}

TEST(BadInput, APipeInPlaceOfAFilmOrATrajectoryIsRefused) {
  const TemporaryFolder folder;
  for (const char* name : {"walk.r3d", "walk.csv", "walk.mov"}) {
    ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
  }
  for (const char* name : {"walk.r3d", "walk.csv"}) {
    ExpectRefused(RunPleinair({"path", "convert", folder / name, folder / "a.tum"}),
                  std::string(name) + ": is a pipe, not a file");
  }
  ExpectRefused(RunPleinair({"film", folder / "walk.mov"}), "walk.mov: is a pipe, not a file");
  ExpectRefused(RunPleinair({"new", folder / "walk.mov", "--yes", "-o", folder / "site"}),
                "walk.mov: is a pipe, not a file");
}

TEST(BadInput, AFolderInPlaceOfARunIsRefused) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "out/run.json");
  ExpectRefused(RunPleinair({"report", "merge", folder / "out"}), "there is no accuracy run");
}

TEST(BadInput, OptionsOfDaylightCoefficientsAreRefusedWhereNoneAreTraced) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, false);
  for (const auto& [option, value] :
       {std::pair{"--sky-division", "4"}, {"--convergence", "0.05"}}) {
    ExpectRefused(
        RunPleinair({"bench", "replay", folder / "site", "-o", folder / "out", option, value}),
        std::string(option) + ": has no effect here");
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

TEST(BadInput, OptionsForResearchAreRefusedByReplayWhichSaysWhereTheyAre) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, false);
  const auto refuse = [&](std::vector<std::string> words) {
    const std::string option = words.front();
    words.insert(words.begin(), "replay");
    words.insert(words.end(), {"-o", folder / "out"});
    ExpectRefused(RunPleinair(words), option + ": is an option of 'pleinair bench replay'");
    EXPECT_FALSE(fs::exists(folder / "out"));
  };
  refuse({"--shadows", "zgaf", folder / "site"});
  refuse({"--shadow-debug", folder / "site"});
  refuse({"--light-patches", "1000", folder / "site"});
}

TEST(BadInput, AFileInPlaceOfTheLightCacheIsRefused) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, false);
  WriteFile(folder / "cache", "a file");
  ExpectRefused(RunPleinair({"replay", folder / "site", "-o", folder / "out", "--light-cache",
                             folder / "cache"}),
                "cache: is no folder");
  EXPECT_EQ(ReadFile(folder / "cache"), "a file");
}

TEST(BadInput, TheRecordingIsNotOverwrittenByItsReplay) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, false);
  const auto before = Listing(folder / "site");
  ExpectRefused(RunPleinair({"replay", folder / "site", "-o", folder / "site"}),
                "is the recording itself");
  EXPECT_EQ(Listing(folder / "site"), before);
}

TEST(BadInput, AnotherRecordingIsNotOverwrittenEither) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, false);
  MakeShortRecording(folder / "other", 2, false);
  const auto before = Listing(folder / "other");
  ExpectRefused(RunPleinair({"replay", folder / "site", "-o", folder / "other", "--frames"}),
                "is a recording");
  ExpectRefused(RunPleinair({"replay", folder / "site", "-o", folder / "other/frames"}),
                "holds the frames of a recording");
  EXPECT_EQ(Listing(folder / "other"), before);
}

TEST(BadInput, AFolderWithoutWritePermissionIsRefused) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, false);
  // /proc rejects new folders from every user, including root.
  const RunResult run = RunPleinair({"replay", folder / "site", "-o", "/proc/pleinair"});
  ExpectRefused(run, "cannot write");
}

TEST(BadInput, AFileInPlaceOfTheOutputFolderIsRefused) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, false);
  WriteFile(folder / "out", "a file");
  ExpectRefused(RunPleinair({"replay", folder / "site", "-o", folder / "out"}), "is not a folder");
}

TEST(BadInput, AFileSizeLimitEndsTheReplayAndLeavesNothing) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 2, false);
  for (const char* output : {"--frames", "--json"}) {  // Images first, or the video.
    // 32 blocks of 512 or 1024 bytes: less than a frame's PNG and the video.
    const RunResult run =
        RunPleinair({"replay", folder / "site", "-o", folder / "out", output}, "ulimit -f 32;");
    ExpectRefused(run, "File too large", 1);
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

TEST(BadInput, AReplayInterruptedSeveralTimesLeavesNothing) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 5, false);
  const std::string out = folder / "out";
  // After it has begun to write, or after a timeout.
  const RunResult run = RunCommandLine(
      {"sh", "-c",
       PleinairProgram() + " replay '" + std::string(folder / "site") + "' -o '" + out +
           "' & n=0; until ls -d '" + out +
           "'/.pleinair.part* >/dev/null 2>&1 || [ $((n += 1)) -gt 5000 ]; do :; done; "
           "kill -INT $!; kill -TERM $!; kill -INT $!; wait $!"});
  ExpectRefused(run, "interrupted", 1);
  EXPECT_FALSE(fs::exists(out));
}

TEST(BadInput, AFullDiskEndsTheReplayAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string disk = folder / "disk";
  fs::create_directory(disk);
  MakeShortRecording(folder / "site", 2, false);
  const auto in_small_disk = [&](const std::string& command) {
    return RunCommandLine({"unshare", "-rm", "sh", "-c",
                           "mount -t tmpfs -o size=96k pleinair '" + disk + "' && " + command});
  };
  if (in_small_disk("true").exit_code != 0) {
    GTEST_SKIP() << "this machine lets nobody mount a small disk";
  }
  for (const char* option : {"--frames", "--json"}) {
    const RunResult run = in_small_disk(
        fmt::format("{} replay '{}' -o '{}/out' {}; code=$?; ls -A '{}'; exit $code",
                    PleinairProgram(), std::string(folder / "site"), disk, option, disk));
    ExpectRefused(run, "No space left on device", 1);
    EXPECT_THAT(run.err, HasSubstr(disk + "/out/"));
    EXPECT_THAT(run.out, IsEmpty());  // Nothing remains on the disk.
  }
}

}  // namespace
}  // namespace pleinair::e2e
