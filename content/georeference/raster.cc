#include "content/georeference/raster.h"

#include <gdal.h>
#include <gdal_frmts.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "content/georeference/gdal_handles.h"
#include "content/georeference/stated_crs.h"

namespace pleinair::content {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRasterRemedy =
    "give a GeoTIFF, Arc/Info ASCII grid (.asc) or Erdas Imagine file (.img); gdal_translate "
    "converts others";

/// Only formats that hold their own cells: others could follow links to files and hosts.
void RegisterRasters() {
  static std::once_flag once;
  std::call_once(once, [] {
    GDALRegister_GTiff();
    GDALRegister_AAIGrid();
    GDALRegister_HFA();
  });
}

}  // namespace

struct RasterFile::Parts {
  std::string where;
  Dataset dataset;
  GDALRasterBandH band = nullptr;
  std::array<double, 6> map_from_cell{};  // GDAL's: of the cells' corners.
  std::string crs, crs_name;
};

RasterFile::RasterFile(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
RasterFile::~RasterFile() = default;
RasterFile::RasterFile(RasterFile&&) noexcept = default;
RasterFile& RasterFile::operator=(RasterFile&&) noexcept = default;

Result<RasterFile> RasterFile::Open(const fs::path& file, int band) {
  const std::string where = file.string();
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return InputError(where, fs::exists(file, error) ? "is not a regular file" : "does not exist",
                      kRasterRemedy);
  }
  // An absolute name has no prefix of another kind of source.
  const std::string path = fs::absolute(file, error).string();
  if (path.starts_with("/vsi")) return InputError(where, "is no file on a disk", kRasterRemedy);
  RegisterRasters();
  const QuietErrors quiet;
  constexpr std::array<const char*, 4> kDrivers = {"GTiff", "AAIGrid", "HFA", nullptr};
  auto parts = std::make_unique<Parts>();
  parts->where = where;
  parts->dataset.reset(GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, kDrivers.data(),
                                  nullptr, nullptr));
  if (!parts->dataset) {
    const std::string message = QuietErrors::Last("");
    return InputError(
        where, message.empty() ? "is no raster that can be read" : "cannot be read: " + message,
        kRasterRemedy);
  }
  GDALDatasetH dataset = parts->dataset.get();
  const int width = GDALGetRasterXSize(dataset), height = GDALGetRasterYSize(dataset);
  if (width < 2 || height < 2 || std::max(width, height) > kMaxRasterFileSide) {
    return InputError(where,
                      "has " + std::to_string(width) + " x " + std::to_string(height) + " cells",
                      "cut out what lies near the marker, with 2 to " +
                          std::to_string(kMaxRasterFileSide) + " cells a side");
  }
  const int bands = GDALGetRasterCount(dataset);
  if (band < 1 || band > bands) {
    return InputError(where, "has no band " + std::to_string(band),
                      "its bands are 1 to " + std::to_string(bands));
  }
  parts->band = GDALGetRasterBand(dataset, band);
  if (GDALGetGeoTransform(dataset, parts->map_from_cell.data()) != CE_None) {
    return InputError(where, "states no place of its cells", "export it with its georeference");
  }
  const StatedCrs crs = ReadStatedCrs(GDALGetSpatialRef(dataset));
  parts->crs = crs.text;
  parts->crs_name = crs.ForPeople();
  return RasterFile(std::move(parts));
}

int RasterFile::width() const { return GDALGetRasterXSize(parts_->dataset.get()); }
int RasterFile::height() const { return GDALGetRasterYSize(parts_->dataset.get()); }
const std::string& RasterFile::crs() const { return parts_->crs; }
const std::string& RasterFile::crs_name() const { return parts_->crs_name; }

MapPoint RasterFile::CentreOf(double x, double y) const {
  const std::array<double, 6>& map = parts_->map_from_cell;
  const double column = x + 0.5, row = y + 0.5;
  return {map[0] + column * map[1] + row * map[2], map[3] + column * map[4] + row * map[5], 0.0};
}

Result<Image<float>> RasterFile::Read(const RasterWindow& window) const {
  if (std::max(window.width, window.height) > kMaxRasterSide) {
    return InputError(parts_->where,
                      std::to_string(window.width) + " x " + std::to_string(window.height) +
                          " of its cells lie within the radius",
                      "choose a smaller radius: at most " + std::to_string(kMaxRasterSide) +
                          " cells a side are read");
  }
  const QuietErrors quiet;
  Image<float> heights(window.width, window.height);
  if (GDALRasterIO(parts_->band, GF_Read, window.x, window.y, window.width, window.height,
                   heights.data(), window.width, window.height, GDT_Float32, 0, 0) != CE_None) {
    return InputError(parts_->where, "is damaged: " + QuietErrors::Last("cannot be read"),
                      "export the file again");
  }
  int has_nodata = 0;
  const double nodata = GDALGetRasterNoDataValue(parts_->band, &has_nodata);
  const double scale = GDALGetRasterScale(parts_->band, nullptr);
  const double offset = GDALGetRasterOffset(parts_->band, nullptr);
  const auto nodata_float = static_cast<float>(nodata);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    float& height = heights.data()[i];
    const bool is_missing = !std::isfinite(height) || (has_nodata != 0 && height == nodata_float);
    height = is_missing ? std::numeric_limits<float>::quiet_NaN()
                        : static_cast<float>(offset + scale * height);
  }
  return heights;
}

}  // namespace pleinair::content
