#include "app/bench/defocus_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/bench/defocus_bench.h"
#include "app/bench/defocus_scenes.h"
#include "app/bench/picture_bench.h"
#include "app/terminal/progress_bar.h"
#include "export/images/image_writer.h"
#include "files/output_rule.h"

namespace pleinair::app {
namespace {

constexpr const char* kDefocusBenchExamples =
    "Examples:\n"
    "  pleinair bench defocus --quick\n"
    "  pleinair bench defocus --scenes boards,fence --methods layered,gather,lens:64\n"
    "  pleinair bench defocus --methods gaussian,gaussian-each --rounds 9 --json > defocus.jsonl\n"
    "Methods: layered (as replay), gaussian (the paper's layers, blurred in cascade),\n"
    "gaussian-each (without the cascade), gather (one depth a pixel), lens:N (N places on the\n"
    "stop), pinhole. The truth is 4,096 traced rays a pixel.";

constexpr const char* kMotionBenchExamples =
    "Examples:\n"
    "  pleinair bench motion --quick\n"
    "  pleinair bench motion --scenes pan,both --methods moved,poses:16,layered-each:32\n"
    "Methods: moved (as replay), poses:N (N poses of the camera, each through its own place on "
    "the\n"
    "stop), layered-each:N (the mean of N images by layers), pinhole (at rest). The truth is "
    "4,096\n"
    "traced rays a pixel, each at its own time of the exposure.";

/// One of the two benchmarks.
struct BoardBench {
  std::span<const std::string_view> scenes;
  std::vector<std::string> methods;  ///< By default.
};

struct DefocusBenchArguments {
  BoardBench kind;
  PictureBenchArguments pictures;
  std::string output;
};

nlohmann::ordered_json DefocusRowJson(const DefocusBenchRow& row) {
  return {{"scene", row.scene},   {"method", row.method},
          {"rmse", row.rmse},     {"edge_rmse", row.edge_rmse},
          {"halo", row.halo},     {"ms", row.ms},
          {"cpu_ms", row.cpu_ms}, {"ratio_to_pinhole", row.ratio_to_pinhole},
          {"layers", row.layers}, {"peels", row.peels},
          {"views", row.views}};
}

constexpr const char* kDefocusHead =
    "scene     method           rmse  edge rmse    halo        ms    cpu ms  / pinhole  layers  "
    "peels  views\n";

std::string DefocusRowText(const DefocusBenchRow& row) {
  return fmt::format(
      "{:<10}{:<15}{:>6.4f}{:>11.4f}{:>8.3f}{:>10.1f}{:>10.1f}{:>11.2f}{:>8}{:>7}{:>7}\n",
      row.scene, row.method, row.rmse, row.edge_rmse, row.halo, row.ms, row.cpu_ms,
      row.ratio_to_pinhole, row.layers, row.peels, row.views);
}

std::filesystem::path SheetOf(const std::filesystem::path& folder, std::string_view scene) {
  return folder / (std::string(scene) + ".png");
}

Result<void> RunDefocus(DefocusBenchArguments& arguments) {
  PictureBench& bench = arguments.pictures.bench;
  for (const std::string& method : bench.methods) {
    PLEINAIR_RETURN_IF_ERROR(CheckDefocusMethod(method));
  }
  PLEINAIR_RETURN_IF_ERROR(SettlePictureBench(&arguments.pictures));
  const std::span<const std::string_view> scenes = arguments.kind.scenes;
  if (bench.scenes.empty()) bench.scenes.assign(scenes.begin(), scenes.end());
  if (bench.methods.empty()) bench.methods = arguments.kind.methods;
  const std::filesystem::path folder = arguments.output;
  if (!folder.empty()) {
    for (const std::string_view scene : scenes) {
      PLEINAIR_RETURN_IF_ERROR(files::CheckFreeName(SheetOf(folder, scene)));
    }
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
      return SystemError(folder.string(), "cannot be created: " + error.message(),
                         "name another folder with -o");
    }
  }
  ProgressBar bar("bench", CountBenchSteps(bench, scenes.size(), bench.methods.size()), "rows");
  const bool json = arguments.pictures.json;
  BenchTable table(json ? "" : kDefocusHead);
  DefocusBenchSink sink;
  sink.advance = [&] { bar.Advance(); };
  sink.on_row = [&](const DefocusBenchRow& row) {
    table.Print(json ? DefocusRowJson(row).dump() + '\n' : DefocusRowText(row));
  };
  if (!folder.empty()) {
    sink.on_sheet = [&](const std::string& scene, const RgbImage& sheet) {
      return exports::WritePng(SheetOf(folder, scene), sheet.view());
    };
  }
  return RunDefocusBench(bench, sink);
}

void AddBoardBench(CLI::App& bench, const std::string& name, const std::string& text,
                   const char* examples, const BoardBench& kind, CommandResult& result) {
  CLI::App* command = bench.add_subcommand(name, text);
  command->footer(examples);
  auto arguments = std::make_shared<DefocusBenchArguments>();
  arguments->kind = kind;
  PictureBenchArguments& pictures = arguments->pictures;
  AddPictureBenchOptions(*command, kind.scenes, "Small pictures, one round", &pictures);
  command
      ->add_option("--methods", pictures.bench.methods,
                   fmt::format("Which methods; {} by default", fmt::join(kind.methods, ",")))
      ->delimiter(',')
      ->type_name("NAME,...");
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for a picture a scene: the truth, then the methods from left to "
                   "right; replaces no file there")
      ->type_name("DIR");
  command->callback([arguments, &result] { result.status = RunDefocus(*arguments); });
}

}  // namespace

void AddDefocusBenchCommand(CLI::App& bench, CommandResult& result) {
  AddBoardBench(bench, "defocus",
                "Methods of depth of field against traced rays through a thin lens",
                kDefocusBenchExamples, {DefocusSceneNames(), DefaultDefocusMethods()}, result);
  AddBoardBench(bench, "motion", "Motion blur against traced rays through a moving camera",
                kMotionBenchExamples, {MotionSceneNames(), DefaultMotionMethods()}, result);
}

}  // namespace pleinair::app
