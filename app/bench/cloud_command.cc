#include "app/bench/cloud_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/bench/cloud_bench.h"
#include "app/bench/picture_bench.h"
#include "app/terminal/progress_bar.h"

namespace pleinair::app {
namespace {

constexpr const char* kCloudBenchExamples =
    "Examples:\n"
    "  pleinair bench clouds --quick\n"
    "  pleinair bench clouds --json > clouds.jsonl";

constexpr const char* kCloudHead =
    "case                  method                   R       T  T direct  reference     error       "
    " "
    "ms\n";

struct CloudBenchArguments {
  bool quick = false, json = false;
};

std::string CloudRowText(const CloudBenchRow& row, bool json) {
  if (!json) {
    return fmt::format("{:<22}{:<18}{:>8.4f}{:>8.4f}{:>10.4f}{:>11.4f}{:>9.2f} %{:>10.1f}\n",
                       row.scene, row.method, row.reflected, row.transmitted, row.direct,
                       row.reference, 100.0 * row.relative_error, row.ms);
  }
  const nlohmann::ordered_json object = {{"case", row.scene},
                                         {"method", row.method},
                                         {"R", row.reflected},
                                         {"T", row.transmitted},
                                         {"T_direct", row.direct},
                                         {"reference", row.reference},
                                         {"relative_error", row.relative_error},
                                         {"ms", row.ms}};
  return object.dump() + '\n';
}

Result<void> RunClouds(const CloudBenchArguments& arguments) {
  constexpr int kPhotons = 100'000, kFewPhotons = 4'000;
  ProgressBar bar("bench", CountCloudBenchRows(), "rows");
  BenchTable table(arguments.json ? "" : kCloudHead);
  RunCloudBench(arguments.quick ? kFewPhotons : kPhotons, [&](const CloudBenchRow& row) {
    table.Print(CloudRowText(row, arguments.json));
    bar.Advance();
  });
  return {};
}

}  // namespace

void AddCloudBenchCommand(CLI::App& bench, CommandResult& result) {
  CLI::App* command = bench.add_subcommand(
      "clouds", "Sunlight through layers of clouds against paths of photons: errors and times");
  command->footer(kCloudBenchExamples);
  auto arguments = std::make_shared<CloudBenchArguments>();
  command->add_flag("--quick", arguments->quick, "4,000 photons a case instead of 100,000");
  command->add_flag("--json", arguments->json, "One JSON object a row");
  command->callback([arguments, &result] { result.status = RunClouds(*arguments); });
}

}  // namespace pleinair::app
