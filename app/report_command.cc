#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/accuracy/accuracy_report.h"
#include "app/accuracy/record_parts.h"
#include "app/command.h"

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
  return {};
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

}  // namespace

void AddReportCommand(CLI::App& app, CommandResult& result) {
  CLI::App* report = app.add_subcommand("report", "Merge and compare reports of accuracy runs");
  report->require_subcommand(1);
  AddMerge(report, result);
}

}  // namespace pleinair::app
