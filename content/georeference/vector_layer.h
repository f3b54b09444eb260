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
  bool mended = false;  ///< Its rings crossed themselves; see VectorQuery::mend_areas.
  std::vector<GeometryPart> parts;
  /// Those of VectorQuery::fields, in their order. Unset: the feature or its layer has none.
  std::vector<std::optional<std::string>> values;
};

struct VectorLayer {
  std::string name;
  std::string crs;       ///< Text for MapTransform::Create(); empty: the file states none.
  std::string crs_name;  ///< For people.
  std::vector<MapFeature> features;
};

/// What is read of a file of vectors.
struct VectorQuery {
  std::optional<std::string> layer = {};  ///< That one alone; unset: every layer.
  std::string where = {};  ///< A filter by attributes, in the SQL of OGR; empty: none.
  std::vector<std::string> fields = {};  ///< Attributes to read, in any case of letters.
  /// Areas whose rings cross themselves or each other become valid ones (GEOS MakeValid).
  bool mend_areas = false;
};

/// Reads the layers of a GeoJSON, GeoPackage, Shapefile, FlatGeobuf, KML, GPX, DXF, or of a CSV
/// with a column of WKT, by GDAL, which recognises them by content. Unless it is named, a layer of
/// a GPX file with the points of its tracks and routes is left out. Curves become polylines with
/// steps of 4 degrees. Heights of a GeoJSON file without a `crs` member count as not stated. Errors
/// (input): no file of these kinds, damaged, larger than the limits, no layer with geometry. A
/// layer or field is missing: the error lists those there are. A filter cannot be parsed. A
/// coordinate is not finite: it has the feature's number.
Result<std::vector<VectorLayer>> ReadVectorLayers(const std::filesystem::path& file,
                                                  const VectorQuery& query = {});

/// The same from memory. `name` is that of the file in errors; its extension counts as that of a
/// file. A Shapefile has its .shp alone; the index is restored from it, in memory.
Result<std::vector<VectorLayer>> ParseVectorLayers(std::string_view bytes, const std::string& name,
                                                   const VectorQuery& query = {});

}  // namespace pleinair::content
