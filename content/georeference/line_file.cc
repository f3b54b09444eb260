#include "content/georeference/line_file.h"

#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <memory>
#include <optional>
#include <system_error>

#include "base/atomic_file.h"
#include "content/georeference/gdal_handles.h"
#include "content/georeference/vector_formats.h"

namespace pleinair::content {
namespace {

namespace fs = std::filesystem;

struct SrsDeleter {
  void operator()(void* srs) const { OSRRelease(srs); }
};
struct WrittenFeatureDeleter {
  void operator()(void* feature) const { OGR_F_Destroy(feature); }
};

tl::unexpected<Error> WriteFailure(const fs::path& file) {
  return SystemError(file.string(), "cannot write: " + QuietErrors::Last("GDAL refuses"),
                     "free some space or choose another folder");
}

Result<OGRGeometryH> GeometryOf(const WrittenLine& line, const MapTransform& transform,
                                const std::string& where) {
  OGRGeometryH geometry =
      OGR_G_CreateGeometry(line.points.size() == 1 ? wkbPoint25D : wkbLineString25D);
  for (const GeodeticPoint& point : line.points) {
    const std::optional<MapPoint> at = transform.OnMap(point);
    if (!at) {
      OGR_G_DestroyGeometry(geometry);
      return InputError(where,
                        "feature " + std::to_string(line.feature) + " has no position in " +
                            transform.facts().crs,
                        "choose a coordinate reference system of the region with --crs");
    }
    OGR_G_AddPoint(geometry, at->x, at->y, at->z);
  }
  return geometry;
}

Result<void> WriteLines(OGRLayerH layer, const MapTransform& transform,
                        std::span<const WrittenLine> lines, const fs::path& file) {
  for (const WrittenLine& line : lines) {
    PLEINAIR_ASSIGN_OR_RETURN(OGRGeometryH geometry, GeometryOf(line, transform, file.string()));
    const std::unique_ptr<void, WrittenFeatureDeleter> feature(
        OGR_F_Create(OGR_L_GetLayerDefn(layer)));
    OGR_F_SetFieldInteger64(feature.get(), 0, line.feature);
    OGR_F_SetFieldInteger64(feature.get(), 1, static_cast<GIntBig>(line.part));
    OGR_F_SetGeometryDirectly(feature.get(), geometry);
    if (OGR_L_CreateFeature(layer, feature.get()) != OGRERR_NONE) return WriteFailure(file);
  }
  return {};
}

Result<void> WriteDataset(const fs::path& temporary, const std::string& crs,
                          const MapTransform& transform, std::span<const WrittenLine> lines,
                          const fs::path& file) {
  const Dataset dataset(GDALCreate(GDALGetDriverByName("GPKG"), temporary.string().c_str(), 0, 0, 0,
                                   GDT_Unknown, nullptr));
  if (!dataset) return WriteFailure(file);
  const std::unique_ptr<void, SrsDeleter> srs(OSRNewSpatialReference(nullptr));
  if (OSRSetFromUserInput(srs.get(), crs.c_str()) != OGRERR_NONE) {
    return InputError("--crs", "\"" + crs.substr(0, 60) + "\" cannot be written to a GeoPackage",
                      "give a code such as EPSG:32633");
  }
  OSRSetAxisMappingStrategy(srs.get(), OAMS_TRADITIONAL_GIS_ORDER);
  OGRLayerH layer = GDALDatasetCreateLayer(dataset.get(), "drape", srs.get(), wkbUnknown, nullptr);
  if (!layer) return WriteFailure(file);
  for (const char* name : {"feature", "part"}) {
    OGRFieldDefnH field = OGR_Fld_Create(name, OFTInteger64);
    const OGRErr added = OGR_L_CreateField(layer, field, TRUE);
    OGR_Fld_Destroy(field);
    if (added != OGRERR_NONE) return WriteFailure(file);
  }
  if (GDALDatasetStartTransaction(dataset.get(), FALSE) != OGRERR_NONE) return WriteFailure(file);
  PLEINAIR_RETURN_IF_ERROR(WriteLines(layer, transform, lines, file));
  if (GDALDatasetCommitTransaction(dataset.get()) != OGRERR_NONE) return WriteFailure(file);
  return {};
}

}  // namespace

Result<void> WriteGeoPackage(const fs::path& file, const std::string& crs,
                             const MapTransform& transform, std::span<const WrittenLine> lines) {
  RegisterVectorFormats();
  const QuietErrors quiet;
  const fs::path temporary = fs::absolute(TemporarySibling(file));
  Result<void> written = WriteDataset(temporary, crs, transform, lines, file);
  // What closing the file could not write.
  if (written && CPLGetLastErrorType() >= CE_Failure) written = WriteFailure(file);
  if (!written) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    return written;
  }
  return CommitFile(temporary, file);
}

}  // namespace pleinair::content
