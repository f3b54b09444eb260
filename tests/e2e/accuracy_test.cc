// Tests `pleinair accuracy` and `pleinair report` as processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/run_program.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// Nine frames of four sweeps: four parts.
std::vector<std::string> Small(std::vector<std::string> more) {
  std::vector<std::string> arguments{
      "accuracy", "--sweep",   "negative,sequence,sequence_occl,wild",
      "--scale",  "0.01",      "--seed",
      "4",        "--measure", "blocks"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Accuracy, IsTheSameHoweverItIsDivided) {
  const TemporaryFolder folder;
  const RunResult whole = RunPleinair(Small({"-o", folder / "whole", "--json"}));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(json::parse(whole.out)["parts"], 4);
  for (const int count : {2, 7}) {
    const fs::path shards = folder / std::to_string(count);
    for (int i = 1; i <= count; ++i) {
      // Every second shard writes to a separate folder.
      const std::string to = (i % 2 == 0 ? shards / "even" : shards / "odd").string();
      const std::string shard = std::to_string(i) + "/" + std::to_string(count);
      const RunResult run = RunPleinair(Small({"-o", to, "--shard", shard}));
      ASSERT_EQ(run.exit_code, 0) << run.err;
    }
    const RunResult merged =
        RunPleinair({"report", "merge", shards / "odd", shards / "even", "-o", shards / "all"});
    ASSERT_EQ(merged.exit_code, 0) << merged.err;
    for (const char* file : {"report.json", "report.html", "records.jsonl"}) {
      EXPECT_EQ(ReadFile(shards / "all" / file), ReadFile(folder / "whole" / file))
          << count << " " << file;
    }
    // Half of the parts give no report.
    const RunResult half = RunPleinair({"report", "merge", shards / "odd", "-o", shards / "half"});
    EXPECT_EQ(half.exit_code, 1);
    EXPECT_THAT(half.err, HasSubstr("parts are not there"));
    EXPECT_FALSE(fs::exists(shards / "half"));
  }
  const json report = json::parse(ReadFile(folder / "whole/report.json"));
  EXPECT_EQ(report["detectors"], json({"pleinair"}));
  EXPECT_THAT(ReadFile(folder / "whole/report.html"), Not(HasSubstr("http")));
}

TEST(Accuracy, GoesOnWhereItStoppedAndRefusesAnotherRunsFolder) {
  const TemporaryFolder folder;
  const std::vector<std::string> command{"accuracy", "--sweep", "wild,negative", "--scale",
                                         "0.01",     "-o",      folder / "out",  "--json"};
  const RunResult first = RunPleinair(command);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const std::string report = ReadFile(folder / "out/report.json");
  const std::string part = ReadFile(folder / "out/parts/00001.jsonl");
  // A truncated part, which this program never writes, counts as missing.
  WriteFile(folder / "out/parts/00001.jsonl", part.substr(0, part.size() / 2));
  const RunResult second = RunPleinair(command);
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(json::parse(second.out)["measured_now"], 1);
  EXPECT_EQ(ReadFile(folder / "out/report.json"), report);
  const RunResult other = RunPleinair({"accuracy", "--sweep", "many", "-o", folder / "out"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("another configuration"));
}

TEST(Accuracy, RefusesDamagedRunsByTheirFile) {
  const TemporaryFolder folder;
  ASSERT_EQ(RunPleinair({"accuracy", "--sweep", "wild", "--scale", "0.01", "-o", folder / "run"})
                .exit_code,
            0);
  // Nested so deeply that a recursive function would exhaust the stack.
  constexpr std::size_t kLevels = 100'000;
  const std::string deep = std::string(kLevels, '[') + std::string(kLevels, ']');
  struct Damage {
    const char *file, *what;
    std::string by;
    int exit_code;
    const char* message;
  };
  for (const Damage& damage : {
           Damage{"run.json", "\"format\":1", "\"format\":\"x\"", 2, "run.json: is no run"},
           Damage{"run.json", "\"chunks\":1", "\"chunks\":9999999999", 2, "run.json: is no run"},
           Damage{"run.json", "\"chunks\":1", "\"chunks\":2", 1, "1 of 2 parts are not there"},
           Damage{"run.json", "\"seed\":1", "\"seed\":\"x\"", 2, "run.json: does not hold the"},
           Damage{"run.json", "[\"wild\"]", "[\"mild\"]", 2, "run.json: does not hold the"},
           Damage{"run.json", "\"scale\":0.01", "\"scale\":1e300", 2,
                  "run.json: its scale of 1e+300"},
           Damage{"run.json", "\"scale\":0.01", "\"scale\":0.0", 2, "run.json: its scale of 0 is"},
           Damage{"run.json", "\"spoil_corners_px\":0.0", "\"spoil_corners_px\":101", 2,
                  "run.json: its spoil_corners_px of 101"},
           Damage{"run.json", "\"wild\"", deep, 2, "run.json: is no run"},
           Damage{"parts/00000.jsonl", "\"scale\":0.01", "\"scale\":" + deep, 1, "are not there"},
           Damage{"parts/00000.jsonl", "\"scale\":0.01", "\"scale\":0.02", 2,
                  "another configuration"},
           Damage{"parts/00000.jsonl", "\"hit\"", deep, 1, "are not there"},
           Damage{"parts/00000.jsonl", "\"records\":", "\"records\":\"\",\"r\":", 1,
                  "are not there"},
           Damage{"parts/00000.jsonl", "\"hit\"", "\"hot\"", 1, "are not there"},
       }) {
    const std::string whole = ReadFile(folder / "run" / damage.file);
    const std::size_t at = whole.find(damage.what);
    ASSERT_NE(at, std::string::npos) << damage.what;
    std::string damaged = whole;
    WriteFile(folder / "run" / damage.file,
              damaged.replace(at, std::string(damage.what).size(), damage.by));
    const RunResult run = RunPleinair({"report", "merge", folder / "run", "-o", folder / "merged"});
    EXPECT_EQ(run.exit_code, damage.exit_code) << damage.message;
    EXPECT_THAT(run.err, HasSubstr(damage.message)) << damage.message;
    EXPECT_FALSE(fs::exists(folder / "merged/report.json")) << damage.message;
    WriteFile(folder / "run" / damage.file, whole);
  }
}

// The regression gate: compares this program's results with the recorded baseline
// (docs/guide/accuracy-runs.md describes how to record it). Also tests that the gate detects a
// regression.
TEST(Accuracy, IsNoWorseThanTheBaselineAndASpoiledDetectorIs) {
  const TemporaryFolder folder;
  const std::string baseline = tests::SourceTree() / "tests/accuracy/baseline";
  const auto run = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments{"accuracy", "--sweep", "distance",   "--scale",
                                       "0.05",     "-o",      folder / name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const RunResult measured = RunPleinair(arguments);
    EXPECT_EQ(measured.exit_code, 0) << measured.err;
    return RunPleinair({"report", "diff", baseline, folder / name});
  };
  const RunResult now = run("now", {});
  EXPECT_EQ(now.exit_code, 0) << now.out << now.err;
  EXPECT_THAT(now.out, Not(HasSubstr("WORSE")));
  const RunResult spoiled = run("spoiled", {"--spoil-corners-px", "0.05"});
  EXPECT_EQ(spoiled.exit_code, 1);
  EXPECT_THAT(spoiled.out, HasSubstr("WORSE"));
  EXPECT_THAT(spoiled.err, HasSubstr("got significantly worse"));
}

TEST(Accuracy, GoesOnBehindARecordingThatIsCorrupt) {
  const TemporaryFolder folder;
  for (const char* name : {"good", "bad"}) {
    fs::copy(BundledRecording(), folder / name, fs::copy_options::recursive);
  }
  const std::string picture = ReadFile(folder / "bad/frames/0001.jpg");
  WriteFile(folder / "bad/frames/0001.jpg", picture.substr(0, picture.size() / 2));
  const std::vector<std::string> command{"accuracy",   folder / "bad", folder / "good",
                                         "--no-light", "-o",           folder / "out"};
  const RunResult run = RunPleinair(command);
  EXPECT_EQ(run.exit_code, 2);  // The input is wrong.
  EXPECT_THAT(run.err, HasSubstr("0001.jpg"));
  EXPECT_THAT(run.err, HasSubstr("1 of 2 recordings could not be measured"));
  json report = json::parse(ReadFile(folder / "out/report.json"));
  EXPECT_EQ(report["skipped"].size(), 1U);
  ASSERT_EQ(report["films"].size(), 1U);
  EXPECT_EQ(report["films"][0]["found"], 90);
  EXPECT_LT(report["films"][0]["ate_unaligned_rmse_mm"], 5.0);
  const RunResult merged = RunPleinair({"report", "merge", folder / "out"});
  EXPECT_EQ(merged.exit_code, 1);
  EXPECT_THAT(merged.err, HasSubstr("0001.jpg"));
  // After repair it is measured; the other is not measured again.
  WriteFile(folder / "bad/frames/0001.jpg", picture);
  const RunResult again = RunPleinair(command);
  EXPECT_EQ(again.exit_code, 0) << again.err;
  report = json::parse(ReadFile(folder / "out/report.json"));
  EXPECT_EQ(report["films"].size(), 2U);
  EXPECT_TRUE(report["skipped"].empty());
}

TEST(Accuracy, RefusesWhatItDoesNotKnow) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--sweep", "colour"},
                                                {"--shard", "3/2"},
                                                {"--shard", "0/2"},
                                                {"--shard", "x"},
                                                {"--against", "eyes"},
                                                {"--numbers", "0-5000"},
                                                {"--scale", "nan"}}) {
    std::vector<std::string> arguments{"accuracy", "-o", folder / "out"};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    const RunResult run = RunPleinair(arguments);
    EXPECT_EQ(run.exit_code, 2) << wrong[1];
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
  EXPECT_EQ(RunPleinair({"report", "merge", folder / "nowhere"}).exit_code, 2);
  EXPECT_EQ(RunPleinair({"report", "diff", folder / "nowhere", folder / "nowhere"}).exit_code, 2);
}

}  // namespace
}  // namespace pleinair::e2e
