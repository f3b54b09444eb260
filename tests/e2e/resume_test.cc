#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using std::chrono_literals::operator""s;
using ::testing::HasSubstr;
using ::testing::Not;

class Resume : public ::testing::Test {
 protected:
  Resume() {
    MakeShortRecording(folder_ / "site", 6, true);
    // A small object on level ground: its light is soon traced.
    WriteFile(folder_ / "site/object.obj",
              "v -0.2 -0.2 0\nv 0.2 -0.2 0\nv 0 0.2 0\nv 0 0 0.4\n"
              "f 3 2 1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    std::string scene = ReadFile(Scene());
    const std::string phantom = "[[phantom]]\nfile = \"phantom.obj\"\n";
    WriteFile(Scene(), scene.erase(scene.find(phantom), phantom.size()));
  }

  fs::path Scene() const { return folder_ / "site/scene.toml"; }
  fs::path Unfinished() const { return folder_ / "out/unfinished"; }

  std::vector<std::string> Command(const std::string& out) const {
    std::vector<std::string> command{"replay",   folder_ / "site", "-o",     folder_ / out,
                                     "--frames", "--light",        "stated", "--resume"};
    command.insert(command.end(), along_.begin(), along_.end());
    return command;
  }
  RunResult Replay(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = Command(out);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunPleinair(arguments);
  }

  /// Ends a replay into `out` by a signal as soon as a frame is there.
  void EndReplay(const std::string& signal, const std::string& frame) const {
    const fs::path written = Unfinished() / "frames" / (frame + ".png");
    std::vector<std::string> line{"bash",
                                  "-c",
                                  "signal=$1 written=$2; shift 2\n"
                                  "\"$0\" \"$@\" & pid=$!\n"
                                  "while kill -0 $pid && [ ! -e \"$written\" ]; do\n"
                                  "  sleep 0.01\n"
                                  "done 2>/dev/null\n"
                                  "kill -$signal $pid; wait $pid",
                                  PleinairProgram(),
                                  signal,
                                  written};
    const std::vector<std::string> command = Command("out");
    line.insert(line.end(), command.begin(), command.end());
    RunCommandLine(line);
    ASSERT_TRUE(fs::exists(written));
    ASSERT_FALSE(fs::exists(folder_ / "out/report.json"));
  }

  void ExpectTheBytesOfOneRun() const {
    EXPECT_EQ(Listing(folder_ / "out"), Listing(folder_ / "whole"));
    for (const std::string& name : Listing(folder_ / "whole")) {
      // The reports have the times of the run.
      if (name.starts_with("report.") || fs::is_directory(folder_ / "whole" / name)) continue;
      EXPECT_TRUE(ReadFile(folder_ / "out" / name) == ReadFile(folder_ / "whole" / name)) << name;
    }
  }

  TemporaryFolder folder_;
  std::vector<std::string> along_;  // Options of a given trajectory.
};

TEST_F(Resume, GivesTheBytesOfOneRunAndTakesNoOther) {
  ASSERT_EQ(Replay("whole").exit_code, 0);
  EndReplay("KILL", "0001");
  EndReplay("INT", "0003");
  const std::string identity = ReadFile(Unfinished() / ".resume/identity");
  ExpectRefused(Replay("out", {"--look", "clean"}), "begun by another command");
  WriteFile(Unfinished() / ".resume/identity", "0.0.1 1 1" + identity.substr(identity.find('\n')));
  ExpectRefused(Replay("out"), "begun by pleinair 0.0.1");
  WriteFile(Unfinished() / ".resume/identity", identity);
  const auto changed = fs::last_write_time(Scene());
  WriteFile(Scene(), ReadFile(Scene()) + "# Another one.\n");
  ExpectRefused(Replay("out"), "scene.toml has changed since");
  fs::resize_file(Scene(), fs::file_size(Scene()) - 15);
  fs::last_write_time(Scene(), changed);

  // Damaged frames are composed again, whole ones are not.
  fs::resize_file(Unfinished() / "frames/0001.png", 1000);
  WriteFile(Unfinished() / "frames/.0003.part1.png", "what a killed process was writing");
  const auto written = fs::last_write_time(Unfinished() / "frames/0000.png");
  const RunResult resumed = Replay("out");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(fs::last_write_time(folder_ / "out/frames/0000.png"), written);
  ExpectTheBytesOfOneRun();
  const RunResult again = Replay("out");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.err, HasSubstr("is finished already"));
  // A newer scene is composed anew.
  fs::last_write_time(Scene(), fs::last_write_time(folder_ / "out/report.json") + 5s);
  const RunResult anew = Replay("out");
  EXPECT_EQ(anew.exit_code, 0) << anew.err;
  EXPECT_THAT(anew.err, Not(HasSubstr("is finished already")));
}

TEST_F(Resume, GivesTheBytesOfOneRunAlongATrajectory) {
  along_ = {"--trajectory", tests::SourceTree() / "recordings/courtyard_midday/truth.tum"};
  ASSERT_EQ(Replay("whole").exit_code, 0);
  EndReplay("INT", "0002");
  const RunResult resumed = Replay("out");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  ExpectTheBytesOfOneRun();
}

TEST_F(Resume, LeavesWhatOthersWroteAndNothingAfterAnInputError) {
  fs::create_directories(Unfinished());
  WriteFile(Unfinished() / "novel.txt", "chapter one");
  ExpectRefused(Replay("out"), "no replay wrote it");
  EXPECT_EQ(ReadFile(Unfinished() / "novel.txt"), "chapter one");
  WriteFile(Scene(), "place = 3\n");
  ExpectRefused(Replay("other"), "scene.toml");
  EXPECT_FALSE(fs::exists(folder_ / "other"));
}

}  // namespace
}  // namespace pleinair::e2e
