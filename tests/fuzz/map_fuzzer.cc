#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "content/draping/drape_lines.h"
#include "content/georeference/placed_features.h"
#include "content/georeference/vector_layer.h"

namespace {

using namespace pleinair::content;  // NOLINT(google-build-using-namespace)
using pleinair::Point;
using pleinair::World;

/// A name with the ending that the first bytes belong to.
std::string NameOf(std::string_view bytes) {
  if (bytes.starts_with("SQLite format 3")) return "map.gpkg";
  if (bytes.starts_with(std::string_view("\0\0\x27\x0a", 4))) return "map.shp";
  if (bytes.starts_with("fgb")) return "map.fgb";
  if (bytes.starts_with("<?xml")) {
    return bytes.find("<gpx") != std::string_view::npos ? "map.gpx" : "map.kml";
  }
  if (bytes.starts_with("WKT")) return "map.csv";
  if (bytes.starts_with("0\nSECTION")) return "map.dxf";
  return "map.geojson";
}

/// A slope with a wall.
SurfaceIndex Surface() {
  SurfaceMesh mesh;
  for (const pleinair::Vec3 at :
       {pleinair::Vec3{-900, -900, -9}, pleinair::Vec3{900, -900, 9}, pleinair::Vec3{0, 900, 3},
        pleinair::Vec3{-50, 5, 0}, pleinair::Vec3{50, 5, 0}, pleinair::Vec3{0, 5, 20}}) {
    mesh.vertices.push_back({at});
  }
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.surfaces = {0, 1};
  return *SurfaceIndex::Create(std::move(mesh));
}

void Drape(const std::vector<PlacedLayer>& layers) {
  static const SurfaceIndex surface = Surface();
  std::vector<LineToDrape> lines;
  for (const PlacedLayer& layer : layers) {
    for (const PlacedFeature& feature : layer.features) {
      for (const PlacedPart& part : feature.parts) {
        lines.push_back({static_cast<std::uint32_t>(feature.number), part.kind, part.points, 0.5});
      }
    }
  }
  DrapeOptions options;
  options.threads = 1;
  const DrapedLayer draped = LayerOf(lines, DrapeLines(lines, surface, options));
  for (const DrapedSegment& segment : draped.segments) {
    if (!(std::fabs(segment.to.xyz.z) < 100.0) || !(segment.to_arc_m >= segment.from_arc_m)) {
      std::abort();
    }
  }
}

}  // namespace

// Any bytes give layers of finite coordinates or an error, never a crash. So does placing and
// draping them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  VectorQuery query;
  query.mend_areas = true;
  if (size % 2 == 0) query.where = "status = 'new' OR depth < 1";
  const auto layers = ParseVectorLayers(bytes, NameOf(bytes), query);
  if (!layers) {
    if (layers.error().what.empty()) std::abort();
    return 0;
  }
  for (const VectorLayer& layer : *layers) {
    for (const MapFeature& feature : layer.features) {
      for (const GeometryPart& part : feature.parts) {
        for (const MapPoint& point : part.points) {
          if (!std::isfinite(point.x + point.y + point.z)) std::abort();
        }
      }
    }
  }
  const auto placed =
      PlaceLayers(*layers, "", {.latitude_deg = 50.0, .longitude_deg = 14.0}, 2000.0, "map");
  if (!placed && placed.error().what.empty()) std::abort();
  if (placed) Drape(*placed);
  return 0;
}
