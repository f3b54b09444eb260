#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/commands/command.h"
#include "app/options/number_range.h"
#include "app/options/option_use.h"
#include "app/place/marker_place.h"
#include "app/place/placement.h"
#include "app/place/placement_plan.h"
#include "base/atomic_file.h"
#include "content/georeference/vector_layer.h"
#include "export/images/image_writer.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaceExamples =
    "Examples:\n"
    "  pleinair place parcels.gpkg --at 50.0875,14.4213,220\n"
    "      distance, direction and bounds of every feature, in metres from the marker\n"
    "  pleinair place trail.geojson --scene scene.toml --plan plan.svg\n"
    "      place and heading of the scene, and a plan, north up (SVG or PNG)\n"
    "  pleinair place pipes.shp --at 50.0875,14.4213 --crs EPSG:5514 -o vertices.csv --json\n"
    "      every vertex as a row: east, north, up, longitude, latitude, height\n"
    "Reads GeoJSON, GeoPackage, Shapefile, FlatGeobuf, KML, GPX, DXF and CSV with WKT.\n"
    "docs/guide/maps.md explains heights and warnings.\n";

constexpr double kDefaultRadius_m = 2000.0;
constexpr double kMaxRadius_m = 1e6;
constexpr int kPlanWidth_px = 1000;

struct PlaceArguments {
  std::string file;
  MarkerPlaceArguments marker;
  std::string crs, layer;
  double radius_m = kDefaultRadius_m;
  std::string plan, output;
  bool json = false;
};

Result<void> WritePlan(const Placement& placement, const std::string& plan) {
  const fs::path file = plan;
  const exports::VectorDrawing drawing = DrawPlacement(placement);
  if (file.extension() == ".svg") {
    return WriteFileAtomically(file, exports::DrawingSvg(drawing, kPlanWidth_px));
  }
  const fs::path temporary = TemporarySibling(file);
  const Result<void> written =
      exports::WritePng(temporary, exports::RasterizeDrawing(drawing, kPlanWidth_px).view());
  if (!written) {
    Error error = written.error();
    error.where = plan;
    return tl::make_unexpected(std::move(error));
  }
  return CommitFile(temporary, file);
}

Result<void> CheckEnding(const std::string& file, std::initializer_list<const char*> endings,
                         const std::string& kinds) {
  const std::string ending = fs::path(file).extension().string();
  for (const char* each : endings) {
    if (file.empty() || ending == each) return {};
  }
  return InputError(file, "is no " + kinds + " by its ending", "name a file that ends in " + kinds);
}

Result<void> RunPlace(const PlaceArguments& arguments) {
  PLEINAIR_RETURN_IF_ERROR(CheckEnding(arguments.plan, {".svg", ".png"}, ".svg or .png"));
  PLEINAIR_RETURN_IF_ERROR(CheckEnding(arguments.output, {".csv"}, ".csv"));
  Placement placement;
  placement.file = arguments.file;
  placement.radius_m = arguments.radius_m;
  PLEINAIR_ASSIGN_OR_RETURN(const MarkerPlace marker, ReadMarkerPlace(arguments.marker, "place"));
  placement.place = marker.place;
  placement.marker_from_world = marker.marker_from_world;
  content::VectorQuery query;
  if (!arguments.layer.empty()) query.layer = arguments.layer;
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<content::VectorLayer> layers,
                            content::ReadVectorLayers(arguments.file, query));
  PLEINAIR_ASSIGN_OR_RETURN(placement.layers,
                            content::PlaceLayers(layers, arguments.crs, placement.place,
                                                 arguments.radius_m, arguments.file));
  for (const content::VectorLayer& each : layers) {
    if (!arguments.crs.empty() && !each.crs.empty()) {
      std::cerr << "warning: layer \"" << each.name << "\" states " << each.crs_name
                << "; --crs is used in its place\n";
    }
  }
  for (const std::string& warning : PlacementWarnings(placement)) {
    std::cerr << "warning: " << warning << '\n';
  }
  if (!arguments.output.empty()) {
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(arguments.output, PlacementCsv(placement)));
  }
  if (!arguments.plan.empty()) PLEINAIR_RETURN_IF_ERROR(WritePlan(placement, arguments.plan));
  std::cout << (arguments.json ? PlacementJson(placement) : PlacementText(placement));
  return {};
}

}  // namespace

void AddPlaceCommand(CLI::App& app, CommandResult& result) {
  auto arguments = std::make_shared<PlaceArguments>();
  CLI::App* command =
      app.add_subcommand("place", "Where the features of a map stand around the marker");
  command->footer(kPlaceExamples);
  command->add_option("FILE", arguments->file, "GeoJSON, GeoPackage, Shapefile or another map")
      ->required();
  AddMarkerPlaceOptions(*command, &arguments->marker);
  command
      ->add_option("--crs", arguments->crs,
                   "Coordinate reference system of the file: EPSG:N, WKT or PROJ string")
      ->type_name("CRS");
  command->add_option("--layer", arguments->layer, "This layer alone")->type_name("NAME");
  command
      ->add_option("--radius", arguments->radius_m,
                   "Features farther away count as beyond; all of them is an error")
      ->type_name("M")
      ->check(NumberRange(0.1, kMaxRadius_m))
      ->capture_default_str();
  command->add_option("--plan", arguments->plan, "Plan, north up, .svg or .png")->type_name("F");
  command->add_option("-o,--output", arguments->output, "CSV with a row per vertex")
      ->type_name("F.csv");
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  RefuseEmptyValues(*command);
  command->callback([arguments, &result] { result.status = RunPlace(*arguments); });
}

}  // namespace pleinair::app
