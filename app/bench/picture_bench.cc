#include "app/bench/picture_bench.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "app/options/picture_size.h"

namespace pleinair::app {
namespace {

/// Keeps the first of equal names.
void DropRepeated(std::vector<std::string>* names) {
  std::vector<std::string> kept;
  kept.reserve(names->size());
  for (std::string& name : *names) {
    if (std::find(kept.begin(), kept.end(), name) == kept.end()) kept.push_back(std::move(name));
  }
  *names = std::move(kept);
}

}  // namespace

void AddPictureBenchOptions(CLI::App& command, std::span<const std::string_view> scenes,
                            const std::string& quick_text, PictureBenchArguments* arguments) {
  command.add_option("--scenes", arguments->bench.scenes, "Which scenes; all by default")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>(scenes.begin(), scenes.end())))
      ->type_name("NAME,...");
  CLI::Option* size = command.add_option("--size", arguments->size,
                                         "Size of the pictures, WIDTHxHEIGHT; default 320x240");
  CLI::Option* rounds =
      command
          .add_option("--rounds", arguments->bench.rounds,
                      "Rounds in which all methods are timed in turn; the median counts")
          ->check(CLI::Range(1, 1000))
          ->capture_default_str();
  command.add_flag("--quick", arguments->quick, quick_text)->excludes(size)->excludes(rounds);
  command.add_flag("--json", arguments->json, "One JSON object a row");
}

Result<void> SettlePictureBench(PictureBenchArguments* arguments) {
  PictureBench& bench = arguments->bench;
  if (!arguments->size.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(const ImageSize size, ParsePictureSize("--size", arguments->size));
    bench.width = size.width;
    bench.height = size.height;
  }
  if (arguments->quick) {
    bench.width = 96;
    bench.height = 72;
    bench.rounds = 1;
  }
  DropRepeated(&bench.scenes);
  DropRepeated(&bench.methods);
  return {};
}

std::int64_t CountBenchSteps(const PictureBench& bench, std::size_t all_scenes,
                             std::size_t all_methods) {
  const auto count = [](const std::vector<std::string>& chosen, std::size_t all) {
    return static_cast<std::int64_t>(chosen.empty() ? all : chosen.size());
  };
  return count(bench.scenes, all_scenes) * (1 + count(bench.methods, all_methods));
}

void BenchTable::Print(const std::string& row) {
  std::cout << std::exchange(head_, {}) << row << std::flush;
}

}  // namespace pleinair::app
