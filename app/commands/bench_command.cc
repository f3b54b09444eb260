#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/bench/antialiasing_command.h"
#include "app/bench/cloud_command.h"
#include "app/bench/defocus_command.h"
#include "app/bench/shadow_bench.h"
#include "app/bench/shadow_pictures.h"
#include "app/commands/bench_replay_command.h"
#include "app/commands/command.h"
#include "app/options/number_range.h"
#include "app/terminal/progress_bar.h"
#include "base/atomic_file.h"
#include "files/output_rule.h"
#include "gl/shader_library.h"

namespace pleinair::app {
namespace {

constexpr const char* kBenchExamples =
    "Examples:\n"
    "  pleinair bench shadows\n"
    "  pleinair bench shadows --json > shadows.jsonl\n"
    "  pleinair bench shadows --scenes trees --methods ours,pcf5,zgaf --sizes 1024 -o out/shadows\n"
    "  pleinair bench shadows --equal-texels --split-weight 0.5 --methods "
    "plain,pcf5,csm-pcf5,zgaf\n"
    "  pleinair bench shadows --quick";

struct BenchOptions {
  ShadowBenchOptions bench;
  std::vector<std::string> methods;
  std::string recording;
  std::string output;
  std::string shader_directory;
  bool quick = false;
  bool json = false;
};

nlohmann::json RowJson(const ShadowBenchRow& row, const std::string& renderer) {
  const shadows::ShadowMethodTraits& traits = shadows::TraitsOf(row.method);
  nlohmann::json object = {{"scene", row.scene},
                           {"method", traits.name},
                           {"title", traits.title},
                           {"resolution", row.resolution},
                           {"map_sizes", row.map_sizes},
                           {"split_weight", row.split_weight},
                           {"penumbra_rmse", row.errors.penumbra_rmse},
                           {"rmse", row.errors.rmse},
                           {"bias", row.errors.bias},
                           {"leak_mean", row.errors.leak_mean},
                           {"leak_p99", row.errors.leak_p99},
                           {"over_darkening", row.errors.over_darkening},
                           {"solid_penumbra_rmse", row.solid_errors.penumbra_rmse},
                           {"solid_rmse", row.solid_errors.rmse},
                           {"solid_leak_mean", row.solid_errors.leak_mean},
                           {"pixels", row.errors.pixels},
                           {"penumbra_pixels", row.errors.penumbra_pixels},
                           {"shimmer", row.creep.shimmer.of_visibility},
                           {"truth_shimmer", row.creep.truth_shimmer.of_visibility},
                           {"light_shimmer", row.creep.shimmer.of_light},
                           {"truth_light_shimmer", row.creep.truth_shimmer.of_light},
                           {"maps_ms", row.time.maps_ms},
                           {"scene_ms", row.time.scene_ms},
                           {"ms", row.time.total_ms()},
                           {"cpu_ms", row.time.cpu_ms},
                           {"maps_redrawn_while_creeping", row.creep.redraws}};
  if (!renderer.empty()) object["renderer"] = renderer;
  if (row.ratio_to_plain > 0.0) object["ratio_to_plain"] = row.ratio_to_plain;
  if (row.closed_form) {
    const ClosedFormErrors& closed = *row.closed_form;
    object["penumbra_width_slope"] = closed.width_slope;
    object["contact_gap_mm"] = 1e3 * closed.contact_gap_m;
    object["contact_gap_px"] = closed.contact_gap_m / row.pixel_m;
    for (const EdgeProfile& edge : closed.edges) {
      object["edges"].push_back({{"height_m", edge.height_m},
                                 {"width_ratio", edge.width_ratio},
                                 {"offset_mm", 1e3 * edge.offset_m},
                                 {"offset_px", edge.offset_m / row.pixel_m},
                                 {"jaggedness_mm", 1e3 * edge.jaggedness_m},
                                 {"rmse", edge.rmse},
                                 {"worst", edge.worst}});
    }
  }
  return object;
}

std::string RowText(const ShadowBenchRow& row) {
  const shadows::ShadowMethodTraits& traits = shadows::TraitsOf(row.method);
  return fmt::format(
      "{:<13}{:<12}{:>5}{:>10.4f}{:>9.4f}{:>9.4f}{:>9.4f}{:>9.4f}{:>9.4f}{:>9.4f}{:>8.1f}{:>8.1f}"
      "{:>8.1f}{:>7.2f}\n",
      row.scene, traits.name, row.resolution, row.errors.penumbra_rmse, row.errors.rmse,
      row.errors.bias, row.errors.leak_mean, row.errors.leak_p99, row.errors.over_darkening,
      row.creep.shimmer.of_visibility - row.creep.truth_shimmer.of_visibility, row.time.maps_ms,
      row.time.scene_ms, row.time.cpu_ms, row.ratio_to_plain);
}

constexpr const char* kHead =
    "scene        method      size  penumbra     rmse     bias     leak leak p99   darker  shimmer"
    " maps ms scene ms cpu ms / plain\n";

// Measure repeated entries once.
template <typename T>
void DropRepeated(std::vector<T>& list) {
  auto end = list.begin();
  for (const T& value : list) {
    if (std::find(list.begin(), end, value) == end) *end++ = value;
  }
  list.erase(end, list.end());
}

Result<void> CheckBenchOptions(BenchOptions& options) {
  ShadowBenchOptions& bench = options.bench;
  if (options.quick) {
    bench.width = 192;
    bench.height = 108;
    bench.rays = 64;
    bench.creep_frames = 3;
    bench.resolutions = {256};
  }
  bench.pictures = !options.output.empty();
  if (!options.recording.empty()) bench.recording = options.recording;
  for (const std::string& name : options.methods) {
    const shadows::ShadowMethodTraits* traits = shadows::FindShadowMethod(name);
    if (traits == nullptr) {
      std::string known;
      for (const auto& method : shadows::ShadowMethods()) {
        known += (known.empty() ? "" : ", ") + std::string(method.name);
      }
      return InputError("--methods", "there is no method '" + name + "'", "choose among " + known);
    }
    bench.methods.push_back(traits->method);
  }
  DropRepeated(bench.scenes);
  DropRepeated(bench.methods);
  DropRepeated(bench.resolutions);
  return {};
}

Result<void> WriteResults(const ShadowBenchResult& result, const std::filesystem::path& folder) {
  std::string lines;
  for (const ShadowBenchRow& row : result.rows)
    lines += RowJson(row, result.renderer).dump() + "\n";
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(folder / "shadows.jsonl", lines));
  PLEINAIR_RETURN_IF_ERROR(WriteShadowPictures(result, folder));
  return WriteShadowCharts(result, folder);
}

/// Checks that no file of the user has the name of one that WriteResults() may write.
Result<void> CheckNamesAreFree(const ShadowBenchOptions& bench,
                               const std::filesystem::path& folder) {
  PLEINAIR_RETURN_IF_ERROR(files::CheckFreeName(folder / "shadows.jsonl"));
  for (const std::string& scene : bench.scenes) {
    for (const char* const ending :
         {".jpg", "_methods.jpg", "_errors.jpg", "_error_over_time.svg"}) {
      PLEINAIR_RETURN_IF_ERROR(files::CheckFreeName(folder / (scene + ending)));
    }
    for (const shadows::ShadowMethodTraits& method : shadows::ShadowMethods()) {
      PLEINAIR_RETURN_IF_ERROR(
          files::CheckFreeName(folder / fmt::format("{}_{}_partitions.jpg", scene, method.name)));
    }
  }
  return {};
}

Result<void> RunBench(BenchOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(CheckBenchOptions(options));
  if (!options.output.empty()) {
    // Checked before the minutes of measurement.
    PLEINAIR_RETURN_IF_ERROR(CheckNamesAreFree(options.bench, options.output));
    std::error_code error;
    std::filesystem::create_directories(options.output, error);
    if (error) return tl::make_unexpected(WriteError(options.output, error.value()));
  }
  gl::ShaderLibrary::SetOverrideDirectory(options.shader_directory);
  const ShadowBenchOptions& bench = options.bench;
  const std::size_t methods =
      bench.methods.empty() ? shadows::ShadowMethods().size() : bench.methods.size();
  ProgressBar bar(
      "bench",
      static_cast<std::int64_t>(bench.scenes.size() * (1 + methods * bench.resolutions.size())),
      "rows");
  bool headed = options.json;  // The header is printed with the first row: an earlier error is then
                               // the only output.
  const auto print = [&](const ShadowBenchRow& row) {
    if (!headed) std::cout << kHead;
    headed = true;
    if (!options.json) std::cout << RowText(row) << std::flush;
  };
  PLEINAIR_ASSIGN_OR_RETURN(const ShadowBenchResult result,
                            RunShadowBench(
                                bench, [&] { bar.Advance(); }, print));
  if (!options.output.empty()) PLEINAIR_RETURN_IF_ERROR(WriteResults(result, options.output));
  if (options.json) {
    for (const ShadowBenchRow& row : result.rows) {
      std::cout << RowJson(row, result.renderer).dump() << '\n';
    }
  }
  return {};
}

}  // namespace

void AddBenchCommand(CLI::App& app, CommandResult& result) {
  CLI::App* bench = app.add_subcommand(
      "bench",
      "For research: measure shadows, antialiasing, depth of field, motion blur and clouds, replay "
      "with more options");
  bench->footer(kBenchExamples);
  bench->require_subcommand(1);
  AddAntialiasingBenchCommand(*bench, result);
  AddDefocusBenchCommand(*bench, result);
  AddCloudBenchCommand(*bench, result);
  AddBenchReplayCommand(*bench, result);
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = bench->add_subcommand(
      "shadows", "Every shadow method against rays to the sun's disc: errors and milliseconds");
  command->footer(kBenchExamples);
  command->add_option("--scenes", options->bench.scenes, "Which scenes")
      ->delimiter(',')
      ->check(CLI::IsMember({"pole_and_box", "courtyard", "trees", "wide_field"}))
      ->type_name("NAME,...");
  command->add_option("--methods", options->methods, "Which methods; all by default")
      ->delimiter(',')
      ->type_name("NAME,...");
  CLI::Option* sizes =
      command
          ->add_option("--sizes", options->bench.resolutions,
                       "Texels of a map's side; for ours a power of two")
          ->delimiter(',')
          ->check(CLI::IsMember({128, 256, 512, 768, 1024, 1280, 1536, 1792, 2048, 3072, 4096}))
          ->type_name("N,...");
  command->add_flag("--equal-texels", options->bench.equal_texels,
                    "As many texels in all for every method as maps of N, N/2, N/2, N/4 have");
  command
      ->add_option("--split-weight", options->bench.split_weight,
                   "Lambda of the view's splits for all methods; each one's own by default")
      ->check(NumberRange(0.0, 1.0))
      ->type_name("0...1");
  command
      ->add_option(
          "--recording", options->recording,
          "Recording whose models the courtyard scene uses; default recordings/courtyard_midday")
      ->type_name("FOLDER");
  CLI::Option* rays =
      command->add_option("--rays", options->bench.rays, "Rays a pixel of the truth")
          ->check(CLI::IsMember({64, 256, 1024}))
          ->capture_default_str();
  command
      ->add_option("--rounds", options->bench.timed_rounds,
                   "Rounds in which all methods are timed in turn; the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("-o,--output", options->output,
                   "Folder for pictures, charts and rows; replaces no file there")
      ->type_name("DIR");
  command
      ->add_option("--shader-dir", options->shader_directory,
                   "Shaders of this folder replace those built in")
      ->check(CLI::ExistingDirectory)
      ->type_name("DIR");
  command->add_flag("--quick", options->quick, "Small pictures, few rays, maps of 256")
      ->excludes(sizes)
      ->excludes(rays);
  command->add_flag("--json", options->json, "One JSON object a row");
  command->callback([options, &result] { result.status = RunBench(*options); });
}

}  // namespace pleinair::app
