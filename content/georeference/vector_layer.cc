#include "content/georeference/vector_layer.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <ogr_api.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>

#include "content/georeference/feature_fields.h"
#include "content/georeference/gdal_handles.h"
#include "content/georeference/stated_crs.h"
#include "content/georeference/vector_formats.h"

namespace pleinair::content {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKindsRemedy =
    "give a GeoJSON, GeoPackage, Shapefile, FlatGeobuf, KML, GPX, DXF or CSV with WKT; ogr2ogr "
    "converts others";
constexpr std::size_t kMaxName = 200;     // Bytes, of features and layers.
constexpr int kMaxNesting = 32;           // Collections in collections.
constexpr double kMaxStatedNumber = 1e9;  // As MapTransform: beyond are no metres or degrees.

struct GeometryDeleter {
  void operator()(void* geometry) const { OGR_G_DestroyGeometry(geometry); }
};
using OgrGeometry = std::unique_ptr<void, GeometryDeleter>;

struct FeatureDeleter {
  void operator()(void* feature) const { OGR_F_Destroy(feature); }
};
using Feature = std::unique_ptr<void, FeatureDeleter>;

/// While it lives, this thread opens a Shapefile without its index (.shx).
class RestoredIndex {
 public:
  RestoredIndex() { CPLSetThreadLocalConfigOption(kOption, "YES"); }
  ~RestoredIndex() { CPLSetThreadLocalConfigOption(kOption, nullptr); }
  RestoredIndex(const RestoredIndex&) = delete;
  RestoredIndex& operator=(const RestoredIndex&) = delete;

 private:
  static constexpr const char* kOption = "SHAPE_RESTORE_SHX";
};

/// Returns whether an SQLite file, such as a GeoPackage, has fewer bytes than its header states.
/// SQLite reads such a file as far as it goes. Source: "Database File Format", sqlite.org, 1.3: the
/// size of a page at byte 16, the number of pages at byte 28. That number counts if the two
/// counters at bytes 24 and 92 are equal.
bool IsCutShort(const std::string& path) {
  VSIStatBufL status;
  VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
  if (file == nullptr) return false;
  std::array<unsigned char, 100> header{};
  const std::size_t count = VSIFReadL(header.data(), 1, header.size(), file);
  VSIFCloseL(file);
  constexpr std::string_view kMagic("SQLite format 3\0", 16);
  if (count < header.size() || !std::equal(kMagic.begin(), kMagic.end(), header.begin()) ||
      VSIStatL(path.c_str(), &status) != 0) {
    return false;
  }
  const auto number = [&](std::size_t at, std::size_t bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value = 256 * value + header[at + i];
    return value;
  };
  const std::uint64_t page_bytes = number(16, 2) == 1 ? 65536 : number(16, 2);
  return number(24, 4) == number(92, 4) &&
         static_cast<std::uint64_t>(status.st_size) < page_bytes * number(28, 4);
}

/// Collects the parts of geometries, up to the limits.
class PartCollector {
 public:
  /// Returns false if the geometry is nested too deeply or has too many vertices.
  bool Add(OGRGeometryH geometry, MapFeature* feature, int depth = 0) {
    if (depth > kMaxNesting) return false;
    const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (type == wkbPoint) return AddPart(geometry, PartKind::kPoint, feature);
    if (type == wkbLineString) {
      const bool ring = std::string_view(OGR_G_GetGeometryName(geometry)) == "LINEARRING";
      return AddPart(geometry, ring || in_area_ ? PartKind::kRing : PartKind::kLine, feature);
    }
    const bool area = type == wkbPolygon || type == wkbTriangle;
    const bool was_in_area = std::exchange(in_area_, area);
    bool fits = true;
    for (int i = 0; fits && i < OGR_G_GetGeometryCount(geometry); ++i) {
      fits = Add(OGR_G_GetGeometryRef(geometry, i), feature, depth + 1);
    }
    in_area_ = was_in_area;
    return fits;
  }

 private:
  bool AddPart(OGRGeometryH geometry, PartKind kind, MapFeature* feature) {
    const auto count = static_cast<std::size_t>(std::max(0, OGR_G_GetPointCount(geometry)));
    if (count == 0 || OGR_G_IsEmpty(geometry)) return true;
    vertices_ += count;
    if (vertices_ > kMaxVertices) return false;
    GeometryPart part{kind, std::vector<MapPoint>(count)};
    OGR_G_GetPoints(geometry, &part.points[0].x, sizeof(MapPoint), &part.points[0].y,
                    sizeof(MapPoint), &part.points[0].z, sizeof(MapPoint));
    if (kind == PartKind::kRing && part.points.front() != part.points.back()) {
      part.points.push_back(part.points.front());
    }
    feature->has_heights = feature->has_heights || OGR_G_Is3D(geometry);
    feature->parts.push_back(std::move(part));
    return true;
  }

  std::size_t vertices_ = 0;
  bool in_area_ = false;
};

bool AllFinite(const MapFeature& feature) {
  const auto finite = [](double value) { return std::fabs(value) <= kMaxStatedNumber; };
  return std::all_of(feature.parts.begin(), feature.parts.end(), [&](const GeometryPart& part) {
    return std::all_of(part.points.begin(), part.points.end(), [&](const MapPoint& p) {
      return finite(p.x) && finite(p.y) && finite(p.z);
    });
  });
}

/// The valid geometry of an area; null: it is valid, or has no valid one.
OgrGeometry Mended(OGRGeometryH area) {
  const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(area));
  if ((type != wkbPolygon && type != wkbMultiPolygon) || OGR_G_IsValid(area)) return nullptr;
  OgrGeometry valid(OGR_G_MakeValid(area));
  if (!valid || OGR_G_IsEmpty(valid.get())) return nullptr;
  // Where an area has no width, a line is left of it, which is no border.
  const OGRwkbGeometryType made = wkbFlatten(OGR_G_GetGeometryType(valid.get()));
  if (made == wkbPolygon || made == wkbMultiPolygon) return valid;
  for (int i = OGR_G_GetGeometryCount(valid.get()) - 1; i >= 0; --i) {
    const OGRwkbGeometryType part =
        wkbFlatten(OGR_G_GetGeometryType(OGR_G_GetGeometryRef(valid.get(), i)));
    if (part != wkbPolygon && part != wkbMultiPolygon) OGR_G_RemoveGeometry(valid.get(), i, 1);
  }
  return OGR_G_IsEmpty(valid.get()) ? nullptr : std::move(valid);
}

/// At most `max_length` bytes without control characters, which a terminal would obey.
std::string PrintableName(std::string name, std::size_t max_length) {
  if (name.size() > max_length) name.resize(max_length);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return (c >= 0 && c < ' ') || c == 127; }, ' ');
  return name;
}

std::string NameOfFeature(OGRFeatureH feature) {
  const int field = OGR_F_GetFieldIndex(feature, "name");  // In any case.
  if (field < 0 || !OGR_F_IsFieldSetAndNotNull(feature, field)) return {};
  return PrintableName(OGR_F_GetFieldAsString(feature, field), kMaxName);
}

/// The CRS that the layer states.
void ReadCrs(OGRLayerH layer, bool geojson, VectorLayer* out) {
  StatedCrs stated = ReadStatedCrs(OGR_L_GetSpatialRef(layer));
  // GDAL's choice for every GeoJSON file with heights, whether it states them or not.
  if (geojson && stated.text == "EPSG:4979") stated.text = "EPSG:4326";
  out->crs = stated.text;
  out->crs_name = stated.ForPeople();
}

/// Counts over all layers of a file.
struct Counts {
  PartCollector collector;
  std::size_t features = 0;
};

Result<void> ReadGeometry(OGRGeometryH geometry, bool mend_areas, const std::string& where,
                          PartCollector* collector, MapFeature* read) {
  const OgrGeometry linear(OGR_G_HasCurveGeometry(geometry, 1)
                               ? OGR_G_GetLinearGeometry(geometry, 0.0, nullptr)
                               : nullptr);
  if (linear) geometry = linear.get();
  const OgrGeometry valid = mend_areas ? Mended(geometry) : nullptr;
  read->mended = valid != nullptr;
  if (collector->Add(valid ? valid.get() : geometry, read)) return {};
  return InputError(where,
                    "feature " + std::to_string(read->number) + " exceeds " +
                        std::to_string(kMaxVertices) + " vertices in all, or is nested too deeply",
                    "simplify the geometry, or choose a layer");
}

Result<VectorLayer> ReadLayer(OGRLayerH layer, bool geojson, const VectorQuery& query,
                              const std::string& where, Counts* counts) {
  VectorLayer out;
  out.name = PrintableName(OGR_L_GetName(layer), kMaxName);
  ReadCrs(layer, geojson, &out);
  PLEINAIR_ASSIGN_OR_RETURN(const FeatureFields fields,
                            FeatureFields::Create(OGR_L_GetLayerDefn(layer), query, where));
  OGR_L_ResetReading(layer);
  CPLErrorReset();
  while (const Feature feature{OGR_L_GetNextFeature(layer)}) {
    if (!fields.Selects(feature.get())) continue;
    MapFeature read;
    read.number = counts->features++;
    read.name = NameOfFeature(feature.get());
    read.values = fields.ValuesOf(feature.get());
    if (OGRGeometryH geometry = OGR_F_GetGeometryRef(feature.get())) {
      PLEINAIR_RETURN_IF_ERROR(
          ReadGeometry(geometry, query.mend_areas, where, &counts->collector, &read));
    }
    if (!AllFinite(read)) {
      return InputError(where,
                        "feature " + std::to_string(read.number) +
                            " has a coordinate that is no finite number of metres or degrees",
                        "repair that feature");
    }
    out.features.push_back(std::move(read));
  }
  if (CPLGetLastErrorType() >= CE_Failure) {
    return InputError(where, "is damaged: " + QuietErrors::Last("cannot be read"),
                      "export the file again");
  }
  return out;
}

/// Layers with the points of what other layers have as lines.
bool RepeatsOthers(const std::string& driver, const std::string& layer) {
  return driver == "GPX" && (layer == "track_points" || layer == "route_points");
}

Result<std::vector<VectorLayer>> ReadDataset(const std::string& path, const std::string& where,
                                             const VectorQuery& query) {
  RegisterVectorFormats();
  const QuietErrors quiet;
  if (IsCutShort(path)) {
    return InputError(where, "is damaged: it has fewer bytes than its header states",
                      "copy or export the file again");
  }
  constexpr std::array<const char*, 9> kDrivers = {
      "GeoJSON", "GPKG", "ESRI Shapefile", "FlatGeobuf", "KML", "GPX", "CSV", "DXF", nullptr};
  const Dataset dataset(GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, kDrivers.data(),
                                   nullptr, nullptr));
  if (!dataset) {
    const std::string message = QuietErrors::Last("");
    return InputError(
        where,
        message.empty() ? "is no map of vectors that can be read" : "cannot be read: " + message,
        kKindsRemedy);
  }
  const std::string driver = GDALGetDriverShortName(GDALGetDatasetDriver(dataset.get()));
  std::vector<VectorLayer> layers;
  std::string names;
  Counts counts;
  const std::optional<std::string>& wanted = query.layer;
  for (int i = 0; i < GDALDatasetGetLayerCount(dataset.get()); ++i) {
    OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), i);
    if (!layer) continue;
    const std::string name = OGR_L_GetName(layer);
    names += (names.empty() ? "" : ", ") + name;
    if (wanted ? name != *wanted
               : OGR_L_GetGeomType(layer) == wkbNone || RepeatsOthers(driver, name)) {
      continue;
    }
    PLEINAIR_ASSIGN_OR_RETURN(VectorLayer read,
                              ReadLayer(layer, driver == "GeoJSON", query, where, &counts));
    layers.push_back(std::move(read));
  }
  if (layers.empty() && wanted) {
    return InputError(where, "has no layer \"" + wanted->substr(0, 60) + "\"",
                      "its layers are: " + names.substr(0, 300));
  }
  if (layers.empty()) return InputError(where, "has no layer with geometry", kKindsRemedy);
  return layers;
}

}  // namespace

Result<std::vector<VectorLayer>> ReadVectorLayers(const fs::path& file, const VectorQuery& query) {
  const std::string where = file.string();
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return InputError(where, fs::exists(file, error) ? "is not a regular file" : "does not exist",
                      kKindsRemedy);
  }
  if (fs::file_size(file, error) > kMaxVectorFileBytes) {
    return InputError(where, "has more than 4 GiB", "cut out what lies near the marker");
  }
  // An absolute name is neither text nor has a prefix of another kind of source.
  const std::string path = fs::absolute(file, error).string();
  if (path.starts_with("/vsi")) return InputError(where, "is no file on a disk", kKindsRemedy);
  return ReadDataset(path, where, query);
}

Result<std::vector<VectorLayer>> ParseVectorLayers(std::string_view bytes, const std::string& name,
                                                   const VectorQuery& query) {
  static std::atomic<int> count{0};
  const std::string folder = "/vsimem/pleinair-" + std::to_string(count++);
  const std::string path = folder + "/map" + fs::path(name).extension().string();
  // GDAL only reads: the dataset is opened without the right to change it.
  auto* data = reinterpret_cast<GByte*>(const_cast<char*>(bytes.data()));
  VSILFILE* file = VSIFileFromMemBuffer(path.c_str(), data, bytes.size(), FALSE);
  if (!file) return InputError(name, "is empty", kKindsRemedy);
  VSIFCloseL(file);
  // GDAL may write the index of a Shapefile into that folder, never to a disk.
  const RestoredIndex restored;
  auto layers = ReadDataset(path, name, query);
  VSIRmdirRecursive(folder.c_str());
  return layers;
}

}  // namespace pleinair::content
