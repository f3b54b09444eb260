#include "app/bench/antialiasing_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "app/bench/antialiasing_bench.h"
#include "app/bench/antialiasing_scenes.h"
#include "app/options/picture_size.h"
#include "app/terminal/progress_bar.h"
#include "gl/shader_library.h"

namespace pleinair::app {
namespace {

constexpr const char* kAntialiasingBenchExamples =
    "Examples:\n"
    "  pleinair bench antialiasing --quick\n"
    "  pleinair bench antialiasing --scenes boards,rails --methods none,msaa\n"
    "  pleinair bench antialiasing --size 640x480 --rounds 9 --json > antialiasing.jsonl";

struct AntialiasingBenchArguments {
  AntialiasingBenchOptions bench;
  std::string size, shader_directory;
  bool quick = false, json = false;
};

nlohmann::ordered_json AntialiasingRowJson(const AntialiasingBenchRow& row) {
  nlohmann::ordered_json object = {{"scene", row.scene},
                                   {"method", row.method},
                                   {"rmse", row.errors.rmse},
                                   {"silhouette_rmse", row.errors.silhouette_rmse},
                                   {"shadow_rmse", row.errors.shadow_rmse},
                                   {"inside_rmse", row.errors.inside_rmse},
                                   {"worst", row.errors.worst},
                                   {"shimmer", row.shimmer},
                                   {"truth_shimmer", row.truth_shimmer},
                                   {"ms", row.ms},
                                   {"cpu_ms", row.cpu_ms}};
  if (row.ratio_to_none > 0.0) object["ratio_to_none"] = row.ratio_to_none;
  return object;
}

constexpr const char* kAntialiasingHead =
    "scene       method       rmse  silhouette  shadow  inside   worst  shimmer  (truth)      ms"
    "  cpu ms  / none\n";

std::string AntialiasingRowText(const AntialiasingBenchRow& row) {
  return fmt::format(
      "{:<12}{:<10}{:>7.4f}{:>12.4f}{:>8.4f}{:>8.4f}{:>8.3f}{:>9.4f}{:>9.4f}{:>8.1f}{:>8.1f}"
      "{:>8.2f}\n",
      row.scene, row.method, row.errors.rmse, row.errors.silhouette_rmse, row.errors.shadow_rmse,
      row.errors.inside_rmse, row.errors.worst, row.shimmer, row.truth_shimmer, row.ms, row.cpu_ms,
      row.ratio_to_none);
}

Result<void> RunAntialiasing(AntialiasingBenchArguments& arguments) {
  AntialiasingBenchOptions& bench = arguments.bench;
  if (!arguments.size.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(const ImageSize size, ParsePictureSize("--size", arguments.size));
    bench.width = size.width;
    bench.height = size.height;
  }
  if (arguments.quick) {
    bench.width = 96;
    bench.height = 72;
    bench.rounds = 1;
    bench.creep_frames = 2;
  }
  gl::ShaderLibrary::SetOverrideDirectory(arguments.shader_directory);
  const auto count = [](const std::vector<std::string>& chosen, std::size_t all) {
    return static_cast<std::int64_t>(
        chosen.empty() ? all : std::set<std::string>(chosen.begin(), chosen.end()).size());
  };
  const std::int64_t methods = count(bench.methods, AntialiasingBenchMethods().size());
  ProgressBar bar("bench", count(bench.scenes, AntialiasingSceneNames().size()) * (1 + methods),
                  "rows");
  bool is_headed = arguments.json;
  return RunAntialiasingBench(
      bench, [&] { bar.Advance(); },
      [&](const AntialiasingBenchRow& row) {
        if (!is_headed) std::cout << kAntialiasingHead;
        is_headed = true;
        std::cout << (arguments.json ? AntialiasingRowJson(row).dump() + '\n'
                                     : AntialiasingRowText(row))
                  << std::flush;
      });
}

}  // namespace

void AddAntialiasingBenchCommand(CLI::App& bench, CommandResult& result) {
  CLI::App* command = bench.add_subcommand(
      "antialiasing", "Every antialiasing method against 64 shaded places a pixel");
  command->footer(kAntialiasingBenchExamples);
  auto arguments = std::make_shared<AntialiasingBenchArguments>();
  const auto scenes = AntialiasingSceneNames();
  command->add_option("--scenes", arguments->bench.scenes, "Which scenes; all by default")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>(scenes.begin(), scenes.end())))
      ->type_name("NAME,...");
  std::vector<std::string> methods;
  for (const AntialiasingBenchMethod& method : AntialiasingBenchMethods()) {
    methods.emplace_back(method.name);
  }
  command->add_option("--methods", arguments->bench.methods, "Which methods; all by default")
      ->delimiter(',')
      ->check(CLI::IsMember(methods))
      ->type_name("NAME,...");
  CLI::Option* size = command->add_option("--size", arguments->size,
                                          "Size of the pictures, WIDTHxHEIGHT; default 320x240");
  CLI::Option* rounds =
      command
          ->add_option("--rounds", arguments->bench.rounds,
                       "Rounds in which all methods are timed in turn; the median counts")
          ->check(CLI::Range(1, 1000))
          ->capture_default_str();
  command
      ->add_option("--shader-dir", arguments->shader_directory,
                   "Shaders of this folder replace those built in")
      ->check(CLI::ExistingDirectory)
      ->type_name("DIR");
  command->add_flag("--quick", arguments->quick, "Small pictures, one round, two frames")
      ->excludes(size)
      ->excludes(rounds);
  command->add_flag("--json", arguments->json, "One JSON object a row");
  command->callback([arguments, &result] { result.status = RunAntialiasing(*arguments); });
}

}  // namespace pleinair::app
