#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/image.h"
#include "content/georeference/map_transform.h"

namespace pleinair::content {

/// Size limits of what is read of a raster.
constexpr int kMaxRasterSide = 8193;
constexpr int kMaxRasterFileSide = 1'000'000;

/// Columns and rows of a raster.
struct RasterWindow {
  int x = 0, y = 0, width = 0, height = 0;
};

/// An open file of heights: GeoTIFF, Arc/Info ASCII grid or Erdas Imagine, by GDAL, which
/// recognises them by content. Row 0 is the first of the file, the northernmost as a rule.
class RasterFile {
 public:
  /// `band`: from 1 on. Errors (input): no file of these kinds, damaged, no such band, no
  /// georeference, larger than kMaxRasterFileSide.
  static Result<RasterFile> Open(const std::filesystem::path& file, int band = 1);
  ~RasterFile();
  RasterFile(RasterFile&&) noexcept;
  RasterFile& operator=(RasterFile&&) noexcept;

  int width() const;
  int height() const;
  const std::string& crs() const;       ///< Text for MapTransform::Create(); empty: none is stated.
  const std::string& crs_name() const;  ///< For people.

  /// The place of a cell's centre in the CRS, without a height: cell (0, 0) is the first one.
  /// Between centres by parts of cells. Files whose values belong to points or to areas have the
  /// same meaning here.
  MapPoint CentreOf(double x, double y) const;

  /// Heights of a window inside the raster, metres in the CRS's reference. Cells without data, and
  /// values that are not finite, are NaN. Errors (input): damaged; a side of more than
  /// kMaxRasterSide cells.
  Result<Image<float>> Read(const RasterWindow& window) const;

 private:
  struct Parts;
  explicit RasterFile(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace pleinair::content
