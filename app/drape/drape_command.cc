#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/command.h"
#include "app/drape/drape_files.h"
#include "app/drape/drape_view.h"
#include "app/drape/draped_map.h"
#include "app/drape/map_lines.h"
#include "app/drape/phantom_surface.h"
#include "app/options/number_range.h"
#include "app/options/option_use.h"
#include "app/place/marker_place.h"
#include "content/draping/chord_error.h"
#include "content/draping/screen_search.h"
#include "scene/marker_heading.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDrapeExamples =
    "Examples:\n"
    "  pleinair drape --scene scene.toml -o lines.csv\n"
    "      the maps of all [[drape]] on the phantoms: every vertex, in marker coordinates and "
    "degrees\n"
    "  pleinair drape --scene scene.toml --drape 2 --crs EPSG:5514 -o lines.gpkg --json\n"
    "      the second one alone, as a GeoPackage for GIS\n"
    "  pleinair drape --scene scene.toml --method screen --calibration phone.yaml \\\n"
    "      --view \"0.2 -3 1.6 -0.70 0 0 0.71\" -o seen.csv\n"
    "      by the search on the screen, with what a camera cannot see\n"
    "docs/guide/draping.md explains the rules of heights and the columns.\n";

struct DrapeArguments {
  std::string scene, output, crs;
  std::string method = "exact", view, calibration;
  int drape = 0;  // 0: all.
  int repeat = 1;
  bool json = false;
};

/// Milliseconds since the last call.
class Lap {
 public:
  double Take() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The drapes that the user asks for.
Result<std::vector<scene::DrapeDescription>> ChosenDrapes(const scene::SceneDescription& scene,
                                                          int number) {
  const std::string where = scene.file.string();
  if (scene.drapes.empty()) {
    return InputError(where, "has no [[drape]]", "add one with the file of a map");
  }
  if (number == 0) return scene.drapes;
  if (number > static_cast<int>(scene.drapes.size())) {
    return InputError("--drape", fmt::format("{} has no [[drape]] {}", where, number),
                      fmt::format("give 1 to {}", scene.drapes.size()));
  }
  return std::vector{scene.drapes[static_cast<std::size_t>(number) - 1]};
}

/// What all drapes of a run share.
struct DrapeRun {
  const scene::SceneDescription& scene;
  const content::SurfaceIndex& surface;
  const content::SurfaceView* view = nullptr;  // Null: none is given.
  bool on_screen = false;
  int repeat = 1;
};

void DrapeOnce(const DrapeRun& run, DrapedMap* map) {
  if (!run.on_screen || map->map.options.own_heights) {
    map->draped = content::DrapeLines(map->map.lines, run.surface, map->map.options);
    return;
  }
  content::ScreenDrape screen =
      content::DrapeOnScreen(map->map.lines, *run.view, run.surface, map->map.options);
  map->draped = std::move(screen.draped);
  map->hidden = std::move(screen.hidden);
}

Result<DrapedMap> DrapeMap(const DrapeRun& run, const scene::DrapeDescription& drape,
                           std::uint32_t first_feature, DrapeTimes* times) {
  if (run.on_screen && drape.on == scene::kOnLowest) {
    return InputError(drape.where, "on = \"lowest\" cannot be found on the screen",
                      "drape it with --method exact");
  }
  Lap lap;
  DrapedMap map;
  map.file = drape.source.file.string();
  PLEINAIR_ASSIGN_OR_RETURN(std::vector<content::VectorLayer> layers, ReadMap(drape));
  times->read += lap.Take();
  PLEINAIR_ASSIGN_OR_RETURN(
      map.map, PlaceMap(run.scene, drape, std::move(layers), run.surface, first_feature));
  times->project += lap.Take();
  double fastest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < run.repeat; ++i) {
    DrapeOnce(run, &map);
    fastest = std::min(fastest, lap.Take());
  }
  times->drape += fastest;
  if (!map.map.options.own_heights) {
    PLEINAIR_RETURN_IF_ERROR(
        content::CheckOnTarget(map.map.lines, map.draped, run.surface, map.file));
    map.max_chord_error_m =
        content::MaxChordError(map.map.lines, map.draped, run.surface, map.map.options.on);
  }
  if (run.view != nullptr && map.hidden.empty()) {
    map.hidden = HiddenVertices(map.draped, run.surface, run.view->centre());
  }
  return map;
}

nlohmann::ordered_json DrapeJson(const DrapedMaps& maps) {
  content::DrapeReport sum;
  std::size_t features = 0, hidden = 0;
  double chord_m = 0.0;
  std::string crs;
  for (const DrapedMap& map : maps.maps) {
    features += map.map.features;
    sum.vertices_in += map.draped.report.vertices_in;
    sum.vertices_out += map.draped.report.vertices_out;
    sum.off_target += map.draped.report.off_target;
    sum.clipped += map.draped.report.clipped;
    chord_m = std::max(chord_m, map.max_chord_error_m);
    for (const std::vector<bool>& piece : map.hidden) {
      hidden += static_cast<std::size_t>(std::count(piece.begin(), piece.end(), true));
    }
    if (crs.find(map.map.crs) == std::string::npos) crs += (crs.empty() ? "" : ", ") + map.map.crs;
  }
  return {
      {"features", features},
      {"vertices_in", sum.vertices_in},
      {"vertices_out", sum.vertices_out},
      {"hidden", hidden},
      {"off_target", sum.off_target},
      {"clipped", sum.clipped},
      {"max_chord_error_m", chord_m},
      {"height_shift_m", 0.0},
      {"crs", crs},
      {"method", maps.method},
      {"milliseconds",
       {{"read", maps.times.read}, {"project", maps.times.project}, {"drape", maps.times.drape}}}};
}

std::string DrapeText(const DrapeArguments& arguments, const nlohmann::ordered_json& json) {
  return fmt::format(
      "{}: {} features, {} vertices of {} draped as {}\n"
      "  {} vertices lie over no surface, {} beyond the radius\n"
      "  largest distance of a line from the surface: {:.1e} m\n",
      arguments.output, json["features"].get<std::size_t>(), json["vertices_in"].get<std::size_t>(),
      json["crs"].get<std::string>(), json["vertices_out"].get<std::size_t>(),
      json["off_target"].get<std::size_t>(), json["clipped"].get<std::size_t>(),
      json["max_chord_error_m"].get<double>());
}

Result<void> CheckViewOptions(const DrapeArguments& arguments) {
  if (arguments.view.empty() && arguments.method == "screen") {
    return InputError("--method", "screen needs the place of the camera",
                      "add --view \"tx ty tz qx qy qz qw\" and --calibration");
  }
  if (arguments.view.empty() != arguments.calibration.empty()) {
    return InputError(arguments.view.empty() ? "--calibration" : "--view",
                      "--view and --calibration belong together", "add the other one");
  }
  return {};
}

Result<void> RunDrape(const DrapeArguments& arguments) {
  DrapeOutput output{arguments.output, {}, {}, arguments.crs};
  PLEINAIR_RETURN_IF_ERROR(CheckDrapeOutput(output));
  PLEINAIR_RETURN_IF_ERROR(CheckViewOptions(arguments));
  PLEINAIR_ASSIGN_OR_RETURN(const scene::SceneDescription scene,
                            scene::ReadSceneDescription(arguments.scene));
  output.marker_from_world = scene::MarkerFromWorld(scene.marker);
  output.place = PlaceOfMarker(scene);
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<scene::DrapeDescription> drapes,
                            ChosenDrapes(scene, arguments.drape));
  PLEINAIR_ASSIGN_OR_RETURN(const content::SurfaceIndex surface, SurfaceOfScene(scene));
  std::unique_ptr<content::SurfaceView> view;
  if (!arguments.view.empty()) {
    std::string warning;
    PLEINAIR_ASSIGN_OR_RETURN(view, ViewOfPhantoms(surface, arguments.view, arguments.calibration,
                                                   output.marker_from_world, &warning));
    if (!warning.empty())
      std::cerr << "warning: " << arguments.calibration << ": " << warning << '\n';
  }
  DrapedMaps maps;
  maps.method = arguments.method;
  const DrapeRun run{scene, surface, view.get(), arguments.method == "screen", arguments.repeat};
  std::uint32_t features = 0;
  for (const scene::DrapeDescription& drape : drapes) {
    PLEINAIR_ASSIGN_OR_RETURN(DrapedMap map, DrapeMap(run, drape, features, &maps.times));
    features += static_cast<std::uint32_t>(map.map.features);
    for (const std::string& warning : map.map.warnings) {
      std::cerr << "warning: " << map.file << ": " << warning << '\n';
    }
    maps.maps.push_back(std::move(map));
  }
  PLEINAIR_RETURN_IF_ERROR(WriteDrape(maps, output));
  const nlohmann::ordered_json json = DrapeJson(maps);
  std::cout << (arguments.json ? json.dump() + "\n" : DrapeText(arguments, json));
  return {};
}

}  // namespace

void AddDrapeCommand(CLI::App& app, CommandResult& result) {
  auto arguments = std::make_shared<DrapeArguments>();
  CLI::App* command =
      app.add_subcommand("drape", "The maps of a scene on its phantoms, as lines with heights");
  command->footer(kDrapeExamples);
  command
      ->add_option("--scene", arguments->scene, "Scene with place, heading, phantoms and [[drape]]")
      ->required()
      ->type_name("F");
  command->add_option("--drape", arguments->drape, "This [[drape]] alone, from 1 on")
      ->check(CLI::Range(1, static_cast<int>(scene::kMaxDrapes)))
      ->type_name("N");
  command
      ->add_option("--crs", arguments->crs,
                   "Coordinate reference system of a GeoPackage: EPSG:N, WKT or PROJ string; "
                   "default WGS 84")
      ->type_name("CRS");
  command->add_option("-o,--output", arguments->output, "Lines: .csv, .geojson, .gpkg, .obj, .glb")
      ->required()
      ->type_name("F");
  command
      ->add_option("--method", arguments->method,
                   "exact: lines lie in the triangles; screen: vertices on what the camera sees")
      ->check(CLI::IsMember({"exact", "screen"}))
      ->capture_default_str();
  command
      ->add_option("--view", arguments->view,
                   "Camera in the marker frame, as a line of a TUM file without its time")
      ->type_name("\"TX TY TZ QX QY QZ QW\"");
  command->add_option("--calibration", arguments->calibration, "Calibration of that camera")
      ->type_name("F");
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  command
      ->add_option("--repeat", arguments->repeat,
                   "Drape so many times and report the shortest time")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  RefuseEmptyValues(*command);
  command->callback([arguments, &result] { result.status = RunDrape(*arguments); });
}

}  // namespace pleinair::app
