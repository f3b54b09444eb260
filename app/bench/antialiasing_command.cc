#include "app/bench/antialiasing_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/bench/antialiasing_bench.h"
#include "app/bench/antialiasing_scenes.h"
#include "app/bench/picture_bench.h"
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
  PictureBenchArguments pictures;
  std::string shader_directory;
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
  PLEINAIR_RETURN_IF_ERROR(SettlePictureBench(&arguments.pictures));
  AntialiasingBenchOptions bench{arguments.pictures.bench};
  if (arguments.pictures.quick) bench.creep_frames = 2;
  gl::ShaderLibrary::SetOverrideDirectory(arguments.shader_directory);
  ProgressBar bar(
      "bench",
      CountBenchSteps(bench, AntialiasingSceneNames().size(), AntialiasingBenchMethods().size()),
      "rows");
  const bool json = arguments.pictures.json;
  BenchTable table(json ? "" : kAntialiasingHead);
  return RunAntialiasingBench(
      bench, [&] { bar.Advance(); },
      [&](const AntialiasingBenchRow& row) {
        table.Print(json ? AntialiasingRowJson(row).dump() + '\n' : AntialiasingRowText(row));
      });
}

}  // namespace

void AddAntialiasingBenchCommand(CLI::App& bench, CommandResult& result) {
  CLI::App* command = bench.add_subcommand(
      "antialiasing", "Every antialiasing method against 64 shaded places a pixel");
  command->footer(kAntialiasingBenchExamples);
  auto arguments = std::make_shared<AntialiasingBenchArguments>();
  PictureBenchArguments& pictures = arguments->pictures;
  AddPictureBenchOptions(*command, AntialiasingSceneNames(),
                         "Small pictures, one round, two frames", &pictures);
  std::vector<std::string> methods;
  for (const AntialiasingBenchMethod& method : AntialiasingBenchMethods()) {
    methods.emplace_back(method.name);
  }
  command->add_option("--methods", pictures.bench.methods, "Which methods; all by default")
      ->delimiter(',')
      ->check(CLI::IsMember(methods))
      ->type_name("NAME,...");
  command
      ->add_option("--shader-dir", arguments->shader_directory,
                   "Shaders of this folder replace those built in")
      ->check(CLI::ExistingDirectory)
      ->type_name("DIR");
  command->callback([arguments, &result] { result.status = RunAntialiasing(*arguments); });
}

}  // namespace pleinair::app
