#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "accuracy/regression.h"
#include "app/accuracy/accuracy_report.h"
#include "app/accuracy/record_parts.h"
#include "app/accuracy/recorded_run.h"
#include "app/commands/command.h"
#include "app/options/number_range.h"

namespace pleinair::app {
namespace {

constexpr const char* kMergeExamples =
    "Examples:\n"
    "  pleinair report merge out/full\n"
    "  pleinair report merge shard1 shard2 shard3 -o out/full\n"
    "DIR: where 'pleinair accuracy --shard I/N -o DIR' wrote; all shards may share one. The "
    "merged\n"
    "report is the same to the last digit however the run was divided.";

struct MergeOptions {
  std::vector<std::string> folders;
  std::string output;
  bool json = false;
};

Result<void> Merge(const MergeOptions& options) {
  std::vector<RecordParts> parts;
  for (const std::string& folder : options.folders) {
    PLEINAIR_ASSIGN_OR_RETURN(RecordParts part, RecordParts::Read(folder));
    parts.push_back(std::move(part));
  }
  const std::string output = options.output.empty() ? options.folders[0] : options.output;
  PLEINAIR_ASSIGN_OR_RETURN(const WrittenReport written, WriteAccuracyReport(parts, output));
  if (options.json) {
    const nlohmann::ordered_json json{
        {"folder", output}, {"frames", written.frames}, {"skipped", written.skipped}};
    std::cout << json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
              << '\n';
  } else {
    std::cout << fmt::format("{} frames: {}/report.html\n", written.frames, output);
  }
  for (const std::string& message : written.skipped) {
    std::cerr << "pleinair report: skipped " << message << '\n';
  }
  if (written.skipped.empty()) return {};
  return SystemError(output, "the report lacks what could not be measured",
                     "correct it and run the shards again: finished parts are kept");
}

void AddMerge(CLI::App* report, CommandResult& result) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command = report->add_subcommand("merge", "Put the shards of an accuracy run together");
  command->footer(kMergeExamples);
  command->add_option("DIR", options->folders, "Folders of shards")->required();
  command->add_option("-o,--output", options->output, "Folder for the report (default: the first)")
      ->type_name("DIR");
  command->add_flag("--json", options->json, "One JSON object on standard output");
  command->callback([options, &result] { result.status = Merge(*options); });
}

constexpr const char* kDiffExamples =
    "Examples:\n"
    "  pleinair report diff out/before out/after\n"
    "  pleinair report diff tests/accuracy/baseline out/now --json\n"
    "OLD, NEW: folders with run.json and records.jsonl, as 'pleinair accuracy' leaves them. Runs "
    "of\n"
    "the same seed are compared scene by scene; of others, level by level. WORSE is what got "
    "worse\n"
    "significantly: the chance that anything is called so where only the noise differs is "
    "--alpha.\n"
    "Exit code 1 where anything got worse.";

struct DiffOptions {
  std::string before, after, detector = kOwnName;
  double alpha = accuracy::RegressionOptions().alpha;
  bool json = false;
};

std::string ChangeText(const accuracy::Change& change) {
  return fmt::format("{:<14}{:<20}{:>7}{:>12.5g}{:>12.5g}{:>10.2g}{:>10.2g}  {}\n", change.sweep,
                     change.measure, change.pairs, change.before, change.after, change.p_worse,
                     change.p_better,
                     change.worse    ? "WORSE"
                     : change.better ? "better"
                                     : "");
}

std::string ChangeJson(const accuracy::Change& change) {
  nlohmann::ordered_json json{
      {"sweep", change.sweep},       {"measure", change.measure}, {"pairs", change.pairs},
      {"before", change.before},     {"after", change.after},     {"p_worse", change.p_worse},
      {"p_better", change.p_better}, {"worse", change.worse},     {"better", change.better}};
  return json.dump() + "\n";
}

Result<void> Diff(const DiffOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(const RecordedRun before, ReadRecordedRun(options.before));
  PLEINAIR_ASSIGN_OR_RETURN(const RecordedRun after, ReadRecordedRun(options.after));
  const std::vector<accuracy::Change> changes =
      accuracy::CompareRuns(before.records, after.records,
                            {.detector = options.detector,
                             .alpha = options.alpha,
                             .same_scenes = before.config.seed == after.config.seed});
  if (changes.empty()) {
    return InputError(options.after,
                      "has no frame of " + options.detector + " in common with " + options.before,
                      "compare runs of the same sweeps");
  }
  if (!options.json) {
    std::cout << fmt::format("{:<14}{:<20}{:>7}{:>12}{:>12}{:>10}{:>10}\n", "sweep", "measure",
                             "pairs", "before", "after", "p worse", "p better");
  }
  int worse = 0;
  for (const accuracy::Change& change : changes) {
    std::cout << (options.json ? ChangeJson(change) : ChangeText(change));
    worse += change.worse;
  }
  if (worse == 0) return {};
  return SystemError(options.after,
                     fmt::format("{} of {} figures got significantly worse", worse, changes.size()),
                     "see the lines above");
}

void AddDiff(CLI::App* report, CommandResult& result) {
  auto options = std::make_shared<DiffOptions>();
  CLI::App* command =
      report->add_subcommand("diff", "What got significantly worse between two accuracy runs");
  command->footer(kDiffExamples);
  command->add_option("OLD", options->before, "Folder of the run before")->required();
  command->add_option("NEW", options->after, "Folder of the run after")->required();
  command->add_option("--detector", options->detector, "Detector whose figures are compared")
      ->capture_default_str();
  command->add_option("--alpha", options->alpha, "Chance of a false alarm, over all figures")
      ->check(NumberRange(1e-9, 0.5))
      ->capture_default_str();
  command->add_flag("--json", options->json, "One JSON object a figure");
  command->callback([options, &result] { result.status = Diff(*options); });
}

}  // namespace

void AddReportCommand(CLI::App& app, CommandResult& result) {
  CLI::App* report = app.add_subcommand("report", "Merge and compare reports of accuracy runs");
  report->footer(
      "Examples:\n"
      "  pleinair report merge shard1 shard2 shard3 -o out/full\n"
      "  pleinair report diff out/before out/after");
  report->require_subcommand(1);
  AddMerge(report, result);
  AddDiff(report, result);
}

}  // namespace pleinair::app
