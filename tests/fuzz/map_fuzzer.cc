#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "content/georeference/placed_features.h"
#include "content/georeference/vector_layer.h"

namespace {

/// A name with the ending that the first bytes belong to.
std::string NameOf(std::string_view bytes) {
  if (bytes.starts_with("SQLite format 3")) return "map.gpkg";
  if (bytes.starts_with(std::string_view("\0\0\x27\x0a", 4))) return "map.shp";
  return "map.geojson";
}

}  // namespace

// Any bytes give layers of finite coordinates or an error, never a crash. So does placing them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pleinair::content;  // NOLINT(google-build-using-namespace)
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto layers = ParseVectorLayers(bytes, NameOf(bytes));
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
  return 0;
}
