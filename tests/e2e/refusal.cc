#include "tests/e2e/refusal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/e2e/run_program.h"

namespace pleinair::e2e {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

void ExpectRefused(const RunResult& run, const std::string& message, int exit_code) {
  EXPECT_EQ(run.exit_code, exit_code) << run.err;
  EXPECT_THAT(run.err, AllOf(StartsWith("pleinair: "), HasSubstr(message)));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_THAT(run.out, IsEmpty());
}

void ExpectRefusal(const std::string& subcommand, const Refusal& refusal) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  std::vector<std::string> arguments = {subcommand};
  for (std::string word : refusal.arguments) {
    const std::size_t at = word.find("OUT");
    if (at != std::string::npos) word.replace(at, 3, (folder / "out").string());
    arguments.push_back(word);
  }
  ExpectRefused(RunPleinair(arguments), refusal.message);
  EXPECT_THAT(Listing(folder / "out"), IsEmpty());
}

void ExpectBrokenLineIsNamed(const std::vector<std::string>& command,
                             const std::string& header_and_row, const std::string& broken,
                             const std::string& row_after) {
  const TemporaryFolder folder;
  WriteFile(folder / "in.csv", header_and_row + broken + row_after);
  for (const bool to_file : {false, true}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--csv", folder / "in.csv"});
    if (to_file) arguments.insert(arguments.end(), {"-o", folder / "out.csv"});
    const RunResult run = RunPleinair(arguments);
    EXPECT_EQ(run.exit_code, 2) << broken;
    EXPECT_THAT(run.err, HasSubstr("in.csv:3: ")) << broken;
    EXPECT_THAT(run.out, IsEmpty()) << broken;
    EXPECT_THAT(Listing(folder.path()), ElementsAre("in.csv"));
  }
}

}  // namespace pleinair::e2e
