#include <array>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/command.h"
#include "app/flow/flow_arguments.h"
#include "app/flow/flow_files.h"
#include "app/flow/flow_lines.h"
#include "app/options/number_range.h"
#include "app/options/option_use.h"

namespace pleinair::app {
namespace {

using content::LineEnd;

constexpr const char* kFlowExamples =
    "Examples:\n"
    "  pleinair flow wind.nc -o lines.svg\n"
    "      streamlines at even distances, as a plan\n"
    "  pleinair flow wind.nc --spacing 500 --time 2025-09-14T11:00:00Z -o lines.geojson\n"
    "      streamlines of that moment, 500 m apart, for a map\n"
    "  pleinair flow river.vti --seeds seeds.csv --direction both -o lines.csv --json\n"
    "      streamlines through points, with their ends and times\n"
    "  pleinair flow wind.nc --seeds seeds.csv --lines path --duration 3600 -o drift.vtp\n"
    "      where particles drift in an hour\n"
    "Reads NetCDF (CF), GRIB, GeoTIFF of 2 or 3 bands, VTK (.vti, .vtr, .vts, .vtk).\n"
    "docs/guide/flow.md explains files, coordinates and the report.\n";

struct FlowChoices {
  std::string lines = "stream", method = "rk45", direction = "forward", interpolation = "linear";
};

nlohmann::ordered_json FlowJson(const FlowLines& result) {
  using nlohmann::ordered_json;
  ordered_json ends;
  for (const LineEnd end : {LineEnd::kLeft, LineEnd::kStagnated, LineEnd::kLength, LineEnd::kClosed,
                            LineEnd::kWall, LineEnd::kDuration}) {
    std::size_t count = 0;
    for (const content::FlowLine& line : result.lines) {
      count += line.upstream_end == end ? 1 : 0;
      count += line.downstream_end == end ? 1 : 0;
    }
    ends[NameOf(end)] = count;
  }
  ordered_json spacing;
  if (result.spacing) {
    spacing = {{"nearest_min_m", result.spacing->nearest_min_m},
               {"covered", result.spacing->covered}};
  }
  return {{"lines", result.lines.size()},
          {"vertices", result.Vertices()},
          {"ends", ends},
          {"field_reads", result.field_reads},
          {"levels", result.levels},
          {"spacing", spacing},
          {"time_range_s", result.time_range_s},
          {"milliseconds",
           {{"read", result.milliseconds[0]},
            {"levels", result.milliseconds[1]},
            {"integrate", result.milliseconds[2]}}}};
}

std::string FlowText(const FlowArguments& arguments, const FlowLines& result) {
  std::string text = fmt::format("{}: {} lines with {} vertices\n", arguments.output,
                                 result.lines.size(), result.Vertices());
  const nlohmann::ordered_json json = FlowJson(result);
  std::string ends;
  for (const auto& [name, count] : json.at("ends").items()) {
    if (count.get<std::size_t>() == 0) continue;
    ends += (ends.empty() ? "" : ", ") + name + " " + std::to_string(count.get<std::size_t>());
  }
  if (!ends.empty()) text += "  ends: " + ends + "\n";
  if (result.spacing) {
    text += fmt::format("  nearest lines: {:.4g} m; covered: {:.1f} %\n",
                        result.spacing->nearest_min_m, 100.0 * result.spacing->covered);
  }
  return text;
}

Result<void> RunFlow(FlowArguments arguments, const FlowChoices& choices) {
  PLEINAIR_RETURN_IF_ERROR(CheckFlowEnding(arguments.output));
  arguments.trace.kind = choices.lines == "path"     ? content::LineKind::kPath
                         : choices.lines == "streak" ? content::LineKind::kStreak
                                                     : content::LineKind::kStream;
  arguments.trace.direction = choices.direction == "both"       ? content::LineDirection::kBoth
                              : choices.direction == "backward" ? content::LineDirection::kBackward
                                                                : content::LineDirection::kForward;
  arguments.method = choices.method == "hierarchical"           ? FlowMethod::kHierarchical
                     : choices.method == "hierarchical-nearest" ? FlowMethod::kHierarchicalNearest
                                                                : FlowMethod::kRk45;
  arguments.read.interpolation = choices.interpolation == "cubic" ? content::Interpolation::kCubic
                                                                  : content::Interpolation::kLinear;
  PLEINAIR_ASSIGN_OR_RETURN(const FlowLines result, MakeFlowLines(arguments));
  for (const std::string& warning : result.warnings) std::cerr << "warning: " << warning << '\n';
  PLEINAIR_RETURN_IF_ERROR(WriteFlowFile(result, arguments.output));
  if (arguments.json) {
    std::cout << FlowJson(result).dump() << '\n';
  } else {
    std::cout << FlowText(arguments, result);
  }
  return {};
}

void AddFileOptions(CLI::App& command, FlowArguments* arguments, FlowChoices* choices) {
  command.add_option("FILE", arguments->file, "Velocities: NetCDF, GRIB, GeoTIFF or VTK")
      ->required();
  CLI::Option* u =
      command.add_option("--u", arguments->read.u, "Array of the component to the east or along x");
  CLI::Option* v = command.add_option("--v", arguments->read.v, "Array to the north or along y");
  CLI::Option* w = command.add_option("--w", arguments->read.w, "Array of the upward component");
  for (CLI::Option* option : {u, v, w}) option->type_name("N");
  command
      .add_option("--vectors", arguments->read.vectors,
                  "Array of vectors of a VTK file; else the active one")
      ->type_name("N")
      ->excludes(u)
      ->excludes(v)
      ->excludes(w);
  command
      .add_option("--crs", arguments->read.crs,
                  "Coordinate reference system, in place of the file's; marker: metres of the "
                  "marker's frame")
      ->type_name("CRS");
  command
      .add_option("--time", arguments->time,
                  "Moment: RFC 3339, or seconds after the first time of the file; else that time")
      ->type_name("T");
  command.add_option("--interpolation", choices->interpolation, "Between the points of the grid")
      ->check(CLI::IsMember({"linear", "cubic"}))
      ->capture_default_str();
  command
      .add_option("--scene", arguments->scene,
                  "Scene with place and heading: lines in marker coordinates")
      ->type_name("F");
}

void AddLineOptions(CLI::App& command, FlowArguments* arguments, FlowChoices* choices) {
  command
      .add_option("--seeds", arguments->seeds,
                  "CSV with the header x,y or x,y,z; geographic files: lon,lat; optionally t")
      ->type_name("F.csv");
  command
      .add_option("--spacing", arguments->spacing_m,
                  "Distance of lines that need no seeds, metres; else 1/40 of the domain")
      ->check(NumberRange(1e-6, 1e7))
      ->type_name("M");
  command.add_option("--lines", choices->lines, "Kind of lines")
      ->check(CLI::IsMember({"stream", "path", "streak"}))
      ->capture_default_str();
  command.add_option("--direction", choices->direction, "Way from the seeds")
      ->check(CLI::IsMember({"forward", "backward", "both"}))
      ->capture_default_str();
  command.add_option("--method", choices->method, "Integration, or levels of 2^k steps")
      ->check(CLI::IsMember({"rk45", "hierarchical", "hierarchical-nearest"}))
      ->capture_default_str();
  command.add_option("--steps", arguments->steps, "Number of steps; of levels a power of two")
      ->check(CLI::Range(1, 1 << 24))
      ->type_name("N");
  command
      .add_option("--step", arguments->trace.step_s,
                  "Seconds between vertices, and between particles of a streakline")
      ->check(NumberRange(1e-9, 1e9))
      ->type_name("S");
  command
      .add_option("--length", arguments->trace.length_m,
                  "Largest length each way, metres; else 4 diagonals of the domain")
      ->check(NumberRange(1e-9, 1e9))
      ->type_name("L");
  command
      .add_option("--duration", arguments->trace.duration_s, "Largest duration each way, seconds")
      ->check(NumberRange(1e-9, 1e12))
      ->type_name("S");
  command
      .add_option("--tolerance", arguments->trace.tolerance_cells,
                  "Error of positions, in cells of the grid")
      ->check(NumberRange(1e-9, 0.1))
      ->type_name("CELLS")
      ->capture_default_str();
}

}  // namespace

void AddFlowCommand(CLI::App& app, CommandResult& result) {
  auto arguments = std::make_shared<FlowArguments>();
  auto choices = std::make_shared<FlowChoices>();
  CLI::App* command = app.add_subcommand("flow", "Lines along wind and currents");
  command->footer(kFlowExamples);
  AddFileOptions(*command, arguments.get(), choices.get());
  AddLineOptions(*command, arguments.get(), choices.get());
  command
      ->add_option("-o,--output", arguments->output,
                   "Lines: .csv, .vtp, .geojson, .glb, .obj; or a plan, .svg")
      ->required()
      ->type_name("OUT");
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  RefuseEmptyValues(*command);
  command->callback(
      [arguments, choices, &result] { result.status = RunFlow(*arguments, *choices); });
}

}  // namespace pleinair::app
