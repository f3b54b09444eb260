#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "content/georeference/map_transform.h"

namespace pleinair::content {

/// Size limits of a file of vectors, and of what is made of any map.
constexpr std::size_t kMaxVectorFileBytes = std::size_t{4} << 30;
constexpr std::size_t kMaxVertices = 20'000'000;

enum class PartKind { kPoint, kLine, kRing };

/// A point, a line, or a ring of an area. A ring repeats its first vertex. Holes are rings of the
/// same feature.
struct GeometryPart {
  PartKind kind = PartKind::kPoint;
  std::vector<MapPoint> points;  ///< In the layer's CRS.
};

/// A feature: what the file has as one thing, in one or more parts. None if its geometry is empty.
struct MapFeature {
  std::size_t number = 0;  ///< From 0 over all layers read.
  std::string name;        ///< Its attribute "name", in any case; empty: it has none.
  bool has_heights = false;
  std::vector<GeometryPart> parts;
};

struct VectorLayer {
  std::string name;
  std::string crs;       ///< Text for MapTransform::Create(); empty: the file states none.
  std::string crs_name;  ///< For people.
  std::vector<MapFeature> features;
};

/// Reads the layers of a GeoJSON, GeoPackage or Shapefile by GDAL, which recognises them by
/// content. `layer`: read that one alone. Curves become polylines with steps of 4 degrees. Heights
/// of a GeoJSON file without a `crs` member count as not stated. Errors (input): no file of these
/// kinds, damaged, larger than the limits, no layer with geometry. A layer of that name is missing:
/// the error lists those there are. A coordinate is not finite: it has the feature's number.
Result<std::vector<VectorLayer>> ReadVectorLayers(const std::filesystem::path& file,
                                                  const std::optional<std::string>& layer = {});

/// The same from memory. `name` is that of the file in errors; its extension counts as that of a
/// file. A Shapefile has its .shp alone; the index is restored from it, in memory.
Result<std::vector<VectorLayer>> ParseVectorLayers(std::string_view bytes, const std::string& name,
                                                   const std::optional<std::string>& layer = {});

}  // namespace pleinair::content
