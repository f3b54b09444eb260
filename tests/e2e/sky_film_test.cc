// Tests the time-lapse video of `pleinair sky`, and what remains of unfinished results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/e2e/command_output.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// Number of images in an MP4: its sample size box (ISO 14496-12, 8.7.3).
int CountFrames(const std::string& mp4) {
  const std::size_t at = mp4.find("stsz");
  if (at == std::string::npos || at + 16 > mp4.size()) return -1;
  int count = 0;
  for (std::size_t i = at + 12; i < at + 16; ++i) {
    count = count * 256 + static_cast<unsigned char>(mp4[i]);
  }
  return count;
}

TEST(Sky, FilmsADay) {
  const TemporaryFolder folder;
  const std::vector<std::string> film = {"sky",
                                         "--at",
                                         "50.0875,14.4213",
                                         "--from",
                                         "2025-09-14T04:00:00Z",
                                         "--to",
                                         "2025-09-14T18:00:00Z",
                                         "--step",
                                         "3600",
                                         "--model",
                                         "perez",
                                         "--size",
                                         "96",
                                         "--fps",
                                         "10"};
  std::vector<std::string> first = film, again = film;
  first.insert(first.end(), {"-o", folder / "a.mp4"});
  again.insert(again.end(), {"-o", folder / "b.mp4"});
  EXPECT_EQ(RunJson(first).at("frames"), 15);
  RunJson(again);
  const std::string bytes = ReadFile(folder / "a.mp4");
  EXPECT_EQ(CountFrames(bytes), 15);
  EXPECT_EQ(ReadFile(folder / "b.mp4"), bytes);
  EXPECT_EQ(Listing(folder.path()).size(), 2u);
}

TEST(Sky, LeavesNothingOfAnInterruptedFilm) {
  const TemporaryFolder folder;
  const std::string out = folder / "a.mp4";
  // After it has begun to write, or after a timeout.
  const RunResult run = RunCommandLine(
      {"sh", "-c",
       PleinairProgram() +
           " sky --at 50,14 --day 2025-06-21 --utc-offset Z --step 60 --size 256 --model perez -o "
           "'" +
           out + "' & n=0; until ls '" + folder.path().string() +
           "'/.a.part* >/dev/null 2>&1 || [ $((n += 1)) -gt 5000 ]; do :; done; kill -INT $!; "
           "wait $!"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_THAT(run.err, AllOf(StartsWith("pleinair: "), HasSubstr("a.mp4: interrupted")));
  EXPECT_THAT(Listing(folder.path()), IsEmpty());
}

TEST(Sky, ReportsAFullDisk) {
  for (const char* name : {"a.exr", "a.hdr", "a.png", "a.mp4"}) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = {"sky",
                                          "--at",
                                          "50,14",
                                          "--model",
                                          "perez",
                                          "--size",
                                          "256",
                                          "-o",
                                          folder / name,
                                          "--time",
                                          "2025-06-21T12:00:00Z"};
    if (std::string(name) == "a.mp4") {
      arguments.insert(arguments.end(), {"--until", "2025-06-21T18:00:00Z", "--step", "300"});
    }
    const RunResult run = RunPleinair(arguments, "ulimit -f 4;");
    EXPECT_EQ(run.exit_code, 1) << name << " " << run.err;
    EXPECT_THAT(run.err, AllOf(HasSubstr(name), HasSubstr("File too large"))) << name;
    EXPECT_THAT(Listing(folder.path()), IsEmpty()) << name;
  }
}

}  // namespace
}  // namespace pleinair::e2e
