#include "app/drape/drape_files.h"

#include <array>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "content/georeference/line_file.h"
#include "content/georeference/map_transform.h"

namespace pleinair::app {
namespace {

using content::DrapedVertex;
using content::GeodeticPoint;

constexpr std::array kEndings = {".csv", ".geojson", ".gpkg", ".obj", ".glb"};

std::string DrapeCsv(const DrapedMaps& maps, const Mat3& marker_from_world) {
  std::string csv = "feature,part,vertex,x_m,y_m,z_m,lon_deg,lat_deg,height_m,from,hidden\n";
  auto end = std::back_inserter(csv);
  for (const NumberedPiece& piece : NumberedPieces(maps)) {
    std::size_t number = 0;
    for (const DrapedVertex& vertex : piece.vertices()) {
      const Vec3 at = marker_from_world * vertex.at.xyz;
      const GeodeticPoint on_earth = piece.map->map.frame.Geodetic(vertex.at);
      end = fmt::format_to(end, "{},{},{},{:.6f},{:.6f},{:.6f},{:.11f},{:.11f},{:.6f},{},{}\n",
                           piece.feature, piece.part, number, at.x, at.y, at.z,
                           on_earth.longitude_deg, on_earth.latitude_deg, on_earth.height_m,
                           vertex.of_file ? "source" : "edge", piece.IsHidden(number) ? 1 : 0);
      ++number;
    }
  }
  return csv;
}

std::string DrapeGeoJson(const DrapedMaps& maps) {
  std::string json = "{\"type\":\"FeatureCollection\",\"features\":[";
  auto end = std::back_inserter(json);
  const char* separator = "\n";
  for (const NumberedPiece& piece : NumberedPieces(maps)) {
    const bool is_point = piece.vertices().size() == 1;
    end = fmt::format_to(end,
                         "{}{{\"type\":\"Feature\",\"properties\":{{\"feature\":{},\"part\":{}}},"
                         "\"geometry\":{{\"type\":\"{}\",\"coordinates\":{}",
                         separator, piece.feature, piece.part, is_point ? "Point" : "LineString",
                         is_point ? "" : "[");
    separator = "";
    for (const DrapedVertex& vertex : piece.vertices()) {
      const GeodeticPoint at = piece.map->map.frame.Geodetic(vertex.at);
      end = fmt::format_to(end, "{}[{:.11f},{:.11f},{:.6f}]", separator, at.longitude_deg,
                           at.latitude_deg, at.height_m);
      separator = ",";
    }
    json += is_point ? "}}" : "]}}";
    separator = ",\n";
  }
  return json + "\n]}\n";
}

std::string DrapeObj(const DrapedMaps& maps, const Mat3& marker_from_world) {
  std::string obj = "# Draped lines in marker coordinates, metres.\n";
  auto end = std::back_inserter(obj);
  std::size_t first = 1;
  for (const NumberedPiece& piece : NumberedPieces(maps)) {
    end = fmt::format_to(end, "g feature_{}_part_{}\n", piece.feature, piece.part);
    for (const DrapedVertex& vertex : piece.vertices()) {
      const Vec3 at = marker_from_world * vertex.at.xyz;
      end = fmt::format_to(end, "v {:.6f} {:.6f} {:.6f}\n", at.x, at.y, at.z);
    }
    const std::size_t count = piece.vertices().size();
    obj += count == 1 ? "p" : "l";
    for (std::size_t i = 0; i < count; ++i) end = fmt::format_to(end, " {}", first + i);
    obj += '\n';
    first += count;
  }
  return obj;
}

Result<void> WriteDrapeGeoPackage(const DrapedMaps& maps, const DrapeOutput& output) {
  const std::string crs = output.crs.empty() ? "EPSG:4326" : output.crs;
  PLEINAIR_ASSIGN_OR_RETURN(const content::MapTransform transform,
                            content::MapTransform::Create(crs, output.place, "--crs"));
  std::vector<content::WrittenLine> lines;
  for (const NumberedPiece& piece : NumberedPieces(maps)) {
    content::WrittenLine line{piece.feature, piece.part, {}};
    line.points.reserve(piece.vertices().size());
    for (const DrapedVertex& vertex : piece.vertices()) {
      line.points.push_back(piece.map->map.frame.Geodetic(vertex.at));
    }
    lines.push_back(std::move(line));
  }
  return content::WriteGeoPackage(output.file, crs, transform, lines);
}

}  // namespace

std::vector<NumberedPiece> NumberedPieces(const DrapedMaps& maps) {
  std::vector<NumberedPiece> pieces;
  for (const DrapedMap& map : maps.maps) {
    for (std::size_t i = 0; i < map.draped.pieces.size(); ++i) {
      const std::uint32_t feature = map.map.lines[map.draped.pieces[i].line].feature;
      const bool same = !pieces.empty() && pieces.back().feature == feature;
      pieces.push_back({&map, i, feature, same ? pieces.back().part + 1 : 0});
    }
  }
  return pieces;
}

Result<void> CheckDrapeOutput(const DrapeOutput& output) {
  const std::string ending = output.file.extension().string();
  bool known = false;
  for (const char* each : kEndings) known = known || ending == each;
  if (!known) {
    return InputError(output.file.string(), "has no ending of a kind of file for draped lines",
                      "name a file that ends in .csv, .geojson, .gpkg, .obj or .glb");
  }
  if (!output.crs.empty() && ending != ".gpkg") {
    return InputError("--crs", "is for a GeoPackage, which states it",
                      "leave it out, or name an output that ends in .gpkg");
  }
  return {};
}

Result<void> WriteDrape(const DrapedMaps& maps, const DrapeOutput& output) {
  const std::string ending = output.file.extension().string();
  if (ending == ".gpkg") return WriteDrapeGeoPackage(maps, output);
  return WriteFileAtomically(output.file,
                             ending == ".csv"       ? DrapeCsv(maps, output.marker_from_world)
                             : ending == ".geojson" ? DrapeGeoJson(maps)
                             : ending == ".obj"     ? DrapeObj(maps, output.marker_from_world)
                                                    : DrapeGlb(maps, output.marker_from_world));
}

}  // namespace pleinair::app
