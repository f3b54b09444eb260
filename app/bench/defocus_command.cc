#include "app/bench/defocus_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/bench/defocus_bench.h"
#include "app/bench/defocus_scenes.h"
#include "app/options/picture_size.h"
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
    "stop), pinhole. The truth is lens:1024; --quick takes lens:64.";

struct DefocusBenchArguments {
  DefocusBenchOptions bench;
  std::string size, output;
  bool quick = false, json = false;
};

nlohmann::ordered_json DefocusRowJson(const DefocusBenchRow& row) {
  return {{"scene", row.scene},   {"method", row.method},
          {"rmse", row.rmse},     {"edge_rmse", row.edge_rmse},
          {"halo", row.halo},     {"ms", row.ms},
          {"cpu_ms", row.cpu_ms}, {"ratio_to_pinhole", row.ratio_to_pinhole},
          {"layers", row.layers}, {"peels", row.peels}};
}

constexpr const char* kDefocusHead =
    "scene     method           rmse  edge rmse    halo        ms    cpu ms  / pinhole  layers  "
    "peels\n";

std::string DefocusRowText(const DefocusBenchRow& row) {
  return fmt::format("{:<10}{:<15}{:>6.4f}{:>11.4f}{:>8.3f}{:>10.1f}{:>10.1f}{:>11.2f}{:>8}{:>7}\n",
                     row.scene, row.method, row.rmse, row.edge_rmse, row.halo, row.ms, row.cpu_ms,
                     row.ratio_to_pinhole, row.layers, row.peels);
}

std::filesystem::path SheetOf(const std::filesystem::path& folder, std::string_view scene) {
  return folder / (std::string(scene) + ".png");
}

Result<void> RunDefocus(DefocusBenchArguments& arguments) {
  DefocusBenchOptions& bench = arguments.bench;
  for (const std::string& method : bench.methods) {
    PLEINAIR_RETURN_IF_ERROR(CheckDefocusMethod(method));
  }
  const std::filesystem::path folder = arguments.output;
  if (!folder.empty()) {
    for (const std::string_view scene : DefocusSceneNames()) {
      PLEINAIR_RETURN_IF_ERROR(files::CheckFreeName(SheetOf(folder, scene)));
    }
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
      return SystemError(folder.string(), "cannot be created: " + error.message(),
                         "name another folder with -o");
    }
  }
  if (!arguments.size.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(const ImageSize size, ParsePictureSize("--size", arguments.size));
    bench.width = size.width;
    bench.height = size.height;
  }
  if (arguments.quick) {
    bench.width = 64;
    bench.height = 48;
    bench.rounds = 1;
    bench.truth_places = 64;
  }
  const auto count = [](const std::vector<std::string>& chosen, std::size_t all) {
    return static_cast<std::int64_t>(chosen.empty() ? all : chosen.size());
  };
  const std::int64_t methods = count(bench.methods, DefaultDefocusMethods().size());
  ProgressBar bar("bench", count(bench.scenes, DefocusSceneNames().size()) * (1 + methods), "rows");
  bool is_headed = arguments.json;
  DefocusBenchSink sink;
  sink.advance = [&] { bar.Advance(); };
  sink.on_row = [&](const DefocusBenchRow& row) {
    if (!is_headed) std::cout << kDefocusHead;
    is_headed = true;
    std::cout << (arguments.json ? DefocusRowJson(row).dump() + '\n' : DefocusRowText(row))
              << std::flush;
  };
  if (!folder.empty()) {
    sink.on_sheet = [&](const std::string& scene, const RgbImage& sheet) {
      return exports::WritePng(SheetOf(folder, scene), sheet.view());
    };
  }
  return RunDefocusBench(bench, sink);
}

}  // namespace

void AddDefocusBenchCommand(CLI::App& bench, CommandResult& result) {
  CLI::App* command = bench.add_subcommand(
      "defocus", "Methods of depth of field against 1024 places on the lens's stop");
  command->footer(kDefocusBenchExamples);
  auto arguments = std::make_shared<DefocusBenchArguments>();
  const auto scenes = DefocusSceneNames();
  command->add_option("--scenes", arguments->bench.scenes, "Which scenes; all by default")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>(scenes.begin(), scenes.end())))
      ->type_name("NAME,...");
  command
      ->add_option("--methods", arguments->bench.methods,
                   "Which methods; layered,gaussian,gather,lens:32 by default")
      ->delimiter(',')
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
      ->add_option("-o,--output", arguments->output,
                   "Folder for a picture a scene: the truth, then the methods from left to "
                   "right; replaces no file there")
      ->type_name("DIR");
  command->add_flag("--quick", arguments->quick, "Small pictures, one round")
      ->excludes(size)
      ->excludes(rounds);
  command->add_flag("--json", arguments->json, "One JSON object a row");
  command->callback([arguments, &result] { result.status = RunDefocus(*arguments); });
}

}  // namespace pleinair::app
