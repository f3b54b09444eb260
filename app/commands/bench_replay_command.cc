#include "app/commands/bench_replay_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/replay_options.h"
#include "app/commands/replay_run.h"
#include "app/commands/research_options.h"
#include "app/options/option_use.h"

namespace pleinair::app {
namespace {

constexpr const char* kBenchReplayExamples =
    "Examples:\n"
    "  pleinair bench replay site/ -o out/paper --shadows zgaf --shadow-partitions 4\n"
    "  pleinair bench replay site/ -o out/maps --shadow-debug\n"
    "  pleinair bench replay site/ -o out/fine --light-cache cache --sky-division 4";

Result<void> RunBenchReplay(const CLI::App& command, ReplayArguments& arguments) {
  constexpr const char* kCoefficients = "daylight coefficients (--light-cache or --time-lapse)";
  const bool coefficients = !arguments.options.light.cache.empty() || !arguments.day.hours.empty();
  PLEINAIR_RETURN_IF_ERROR(
      RefuseUnusedOptions(command, {{"--sky-division", coefficients, kCoefficients},
                                    {"--convergence", coefficients, kCoefficients}}));
  return RunReplay(arguments);
}

}  // namespace

void AddBenchReplayCommand(CLI::App& bench, CommandResult& result) {
  CLI::App* command =
      bench.add_subcommand("replay", "As 'pleinair replay', with options for research");
  command->footer(kBenchReplayExamples);
  auto arguments = std::make_shared<ReplayArguments>();
  arguments->command = "bench replay";
  AddReplayOptions(*command, *arguments);
  AddResearchOptions(*command, *arguments);
  command->callback(
      [arguments, command, &result] { result.status = RunBenchReplay(*command, *arguments); });
}

}  // namespace pleinair::app
