#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/utc_time.h"
#include "content/flow/files/field_chart.h"
#include "content/flow/grid_field.h"

namespace pleinair::content {

/// Which velocities of a file, and how they are read.
struct FlowFileOptions {
  /// Names of arrays; empty: by their standard names.
  std::string u = {}, v = {}, w = {};
  std::string vectors = {};  ///< VTK: the array of vectors; empty: the active one.
  std::string crs = {};      ///< In place of the file's.
  Interpolation interpolation = Interpolation::kLinear;
};

/// A file of velocities.
struct FlowFile {
  std::shared_ptr<const GridField> field;
  FieldChart chart;
  std::vector<std::string> arrays;    ///< Names of the components, or of the vectors.
  std::string unit;                   ///< As the file states it.
  std::optional<UtcTime> first_time;  ///< Of its first time; unset: it states none.
  std::vector<std::string> warnings;
  bool has_heights = false;     ///< The field has a vertical axis.
  double half_width_deg = 0.0;  ///< Of a geographic domain, to the side that is wider.
};

/// Reads velocities: NetCDF by the CF conventions, GRIB, GeoTIFF of two or three bands, VTK image
/// data, rectilinear and structured grids (.vti, .vtr, .vts, .vtk). Large files are read time by
/// time. Longitudes may be −180…180 or 0…360, rows from north or south. Components named eastward
/// and northward are true east and north; others run along the grid's axes. Errors (input): no
/// velocities, with the arrays that are there; unknown units; times that do not ascend; no finite
/// velocity; damage; more than kMaxFieldNodes.
Result<FlowFile> ReadFlowFile(const std::filesystem::path& file, const FlowFileOptions& options);

constexpr std::size_t kMaxFieldNodes = std::size_t{1} << 28;

}  // namespace pleinair::content
