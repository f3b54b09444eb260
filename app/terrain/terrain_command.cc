#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/command.h"
#include "app/options/number_range.h"
#include "app/options/option_use.h"
#include "app/place/marker_place.h"
#include "app/place/transform_warnings.h"
#include "base/atomic_file.h"
#include "content/terrain/elevation_mesh.h"
#include "files/csv.h"
#include "scene/described_surface.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTerrainExamples =
    "Examples:\n"
    "  pleinair terrain dem.tif --scene scene.toml -o terrain.obj\n"
    "      the ground within 500 m in marker coordinates, for [[phantom]] of the scene\n"
    "  pleinair terrain dem.tif --at 50.0875,14.4213,220 --radius 100 --max-error 0.02 \\\n"
    "      --height datum -o terrain.obj --json\n"
    "      finer; at the heights of the file; x east, y north\n"
    "Reads GeoTIFF, Arc/Info ASCII grids and Erdas Imagine. docs/guide/maps.md explains heights.\n";

struct TerrainArguments {
  std::string file, output;
  MarkerPlaceArguments marker;
  std::string height = "marker";
  content::TerrainOptions options;
  bool json = false;
};

/// "marker", "datum", or metres that are added to the file's heights.
Result<void> ParseHeight(const std::string& text, content::TerrainOptions* options) {
  if (text == "marker") return {};
  options->height = content::TerrainHeight::kDatum;
  if (text == "datum") return {};
  const std::optional<double> metres = files::ParseNumber(text);
  if (!metres || std::fabs(*metres) > 1e5) {
    return InputError("--height", "\"" + text.substr(0, 60) + "\" is no height",
                      "give marker, datum, or metres to add, for example 0.3");
  }
  options->raised_by_m = *metres;
  return {};
}

/// A Wavefront OBJ in marker coordinates, metres. `material`: its MTL file.
std::string TerrainObj(const content::ElevationMesh& mesh, const Mat3& marker_from_world,
                       const fs::path& material) {
  std::string obj =
      fmt::format("# Terrain in marker coordinates, metres.\nmtllib {}\nusemtl ground\no terrain\n",
                  material.filename().string());
  obj.reserve(obj.size() + 40 * mesh.vertices.size() + 30 * mesh.triangles.size());
  auto end = std::back_inserter(obj);
  for (const Point<World>& vertex : mesh.vertices) {
    const Vec3 at = marker_from_world * vertex.xyz;
    end = fmt::format_to(end, "v {:.4f} {:.4f} {:.4f}\n", at.x, at.y, at.z);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    end = fmt::format_to(end, "f {} {} {}\n", a + 1, b + 1, c + 1);
  }
  return obj;
}

/// The ground's color, unless the user has one already.
Result<void> WriteMaterial(const fs::path& material) {
  std::error_code error;
  if (fs::exists(material, error)) return {};
  const LinearRgb& color = scene::kUsualReflectance;
  return WriteFileAtomically(
      material, fmt::format("newmtl ground\n# Linear reflectance: dry ground, light stone\n"
                            "Kd {} {} {}\nillum 1\n",
                            color.r, color.g, color.b));
}

nlohmann::ordered_json TerrainJson(const TerrainArguments& arguments,
                                   const content::ElevationMesh& mesh) {
  return {{"file", arguments.file},
          {"crs", mesh.crs_name},
          {"operation", mesh.facts.operation},
          {"cells", mesh.cells},
          {"cell_m", mesh.cell_m},
          {"vertices", mesh.vertices.size()},
          {"triangles", mesh.triangles.size()},
          {"max_error_m", arguments.options.max_error_m},
          {"largest_error_m", mesh.remaining_error_m},
          {"height_shift_m", mesh.shift_m},
          {"radius_m", arguments.options.radius_m}};
}

std::string TerrainText(const TerrainArguments& arguments, const content::ElevationMesh& mesh) {
  return fmt::format(
      "{}: {} triangles within {:g} m, from {} cells of {:.2f} m\n"
      "  {}\n"
      "  error of the triangulation: {:.3f} m at most\n"
      "  heights are shifted by {:+.3f} m\n",
      arguments.output, mesh.triangles.size(), arguments.options.radius_m, mesh.cells, mesh.cell_m,
      mesh.crs_name, mesh.remaining_error_m, mesh.shift_m);
}

void WarnOfTerrain(const TerrainArguments& arguments, const content::ElevationMesh& mesh) {
  if (mesh.remaining_error_m > arguments.options.max_error_m) {
    std::cerr << fmt::format(
        "warning: {}: cells are twisted: the error is {:.3f} m where --max-error asks for {:g} m\n",
        arguments.file, mesh.remaining_error_m, arguments.options.max_error_m);
  }
  for (const std::string& warning : TransformWarnings(mesh.facts)) {
    std::cerr << "warning: " << arguments.file << ": " << warning << '\n';
  }
}

Result<void> RunTerrain(TerrainArguments arguments) {
  if (fs::path(arguments.output).extension() != ".obj") {
    return InputError(arguments.output, "is no .obj by its ending",
                      "name a file that ends in .obj");
  }
  PLEINAIR_RETURN_IF_ERROR(ParseHeight(arguments.height, &arguments.options));
  PLEINAIR_ASSIGN_OR_RETURN(const MarkerPlace marker, ReadMarkerPlace(arguments.marker, "terrain"));
  PLEINAIR_ASSIGN_OR_RETURN(
      const content::ElevationMesh mesh,
      content::TriangulateRaster(arguments.file, marker.place, arguments.options));
  WarnOfTerrain(arguments, mesh);
  const fs::path material = fs::path(arguments.output).replace_extension(".mtl");
  PLEINAIR_RETURN_IF_ERROR(WriteMaterial(material));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(
      arguments.output, TerrainObj(mesh, marker.marker_from_world.value_or(Mat3{}), material)));
  if (arguments.json) {
    std::cout << TerrainJson(arguments, mesh).dump() << '\n';
  } else {
    std::cout << TerrainText(arguments, mesh);
  }
  return {};
}

}  // namespace

void AddTerrainCommand(CLI::App& app, CommandResult& result) {
  auto arguments = std::make_shared<TerrainArguments>();
  CLI::App* command =
      app.add_subcommand("terrain", "The ground of an elevation raster as a phantom");
  command->footer(kTerrainExamples);
  command->add_option("FILE", arguments->file, "Elevation raster")->required();
  AddMarkerPlaceOptions(*command, &arguments->marker);
  command
      ->add_option("--height", arguments->height,
                   "marker: the surface passes through the marker's origin (default); datum: the "
                   "file's heights; metres: added to these")
      ->type_name("marker|datum|M");
  command
      ->add_option("--max-error", arguments->options.max_error_m,
                   "Largest vertical error of the triangles, metres")
      ->check(NumberRange(0.001, 100.0))
      ->type_name("M")
      ->capture_default_str();
  command
      ->add_option("--radius", arguments->options.radius_m,
                   "The ground within this distance from the marker, metres")
      ->check(NumberRange(1.0, 20000.0))
      ->type_name("M")
      ->capture_default_str();
  command->add_option("--band", arguments->options.band, "Band of the raster, from 1 on")
      ->type_name("N")
      ->capture_default_str();
  command
      ->add_option(
          "--crs", arguments->options.crs,
          "Coordinate reference system, in place of the file's: EPSG:N, WKT or PROJ string")
      ->type_name("CRS");
  command->add_option("-o,--output", arguments->output, "Triangles in marker coordinates")
      ->required()
      ->type_name("F.obj");
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  RefuseEmptyValues(*command);
  command->callback([arguments, &result] { result.status = RunTerrain(*arguments); });
}

}  // namespace pleinair::app
