#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class SeveralReplays : public ::testing::Test {
 protected:
  SeveralReplays() {
    for (const char* name : {"a", "b", "c"}) MakeShortRecording(folder_ / name, 1, false);
  }
  std::vector<std::string> All() const { return {folder_ / "a", folder_ / "b/", folder_ / "c"}; }
  RunResult Replay(const std::vector<std::string>& recordings,
                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"replay"};
    arguments.insert(arguments.end(), recordings.begin(), recordings.end());
    arguments.insert(arguments.end(), {"-o", folder_ / "out", "--no-video"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunPleinair(arguments);
  }
  bool IsComposed(const std::string& name) const {
    return fs::exists(folder_ / ("out/" + name + "/report.json"));
  }
  TemporaryFolder folder_;
};

TEST_F(SeveralReplays, AreDividedIntoShards) {
  ASSERT_EQ(Replay(All(), {"--shard", "1/2"}).exit_code, 0);
  EXPECT_TRUE(IsComposed("a"));
  EXPECT_FALSE(IsComposed("b"));
  EXPECT_TRUE(IsComposed("c"));
  // As a job array calls it.
  const fs::path script = tests::SourceTree() / "scripts/replay-array";
  const std::string task = "PLEINAIR='" + PleinairProgram() + "' SLURM_ARRAY_TASK_ID=2 " +
                           "SLURM_ARRAY_TASK_COUNT=2 PLEINAIR_OUTPUT='" +
                           (folder_ / "out").string() + "' ";
  const RunResult second = RunCommandLine(
      {"bash", script, folder_ / "a", folder_ / "b", folder_ / "c", "--no-video"}, task);
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_TRUE(IsComposed("b"));
}

TEST_F(SeveralReplays, GoOnAfterOneThatFails) {
  WriteFile(folder_ / "b/scene.toml", "place = 3\n");
  const RunResult run = Replay(All());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, AllOf(HasSubstr("b/scene.toml"), HasSubstr("1 of 3 recordings")));
  EXPECT_TRUE(IsComposed("a"));
  EXPECT_FALSE(IsComposed("b"));
  EXPECT_TRUE(IsComposed("c"));
}

TEST_F(SeveralReplays, OfOneNameAndImpossibleShardsAreRefused) {
  fs::create_directory(folder_ / "other");
  MakeShortRecording(folder_ / "other/a", 1, false);
  ExpectRefused(Replay({folder_ / "a", folder_ / "other/a"}), "same output folder, a");
  ExpectRefused(Replay(All(), {"--shard", "4/3"}), "--shard");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace pleinair::e2e
