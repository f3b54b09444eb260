#include <cpl_string.h>
#include <gdal_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>
#include <utility>

#include "content/flow/files/component_grid.h"
#include "content/flow/files/field_source.h"
#include "content/flow/files/netcdf_file.h"
#include "content/flow/files/velocity_units.h"
#include "content/georeference/stated_crs.h"

namespace pleinair::content {
namespace {

constexpr std::size_t kMaxDoubleBytes = std::size_t{256} << 20;  // A slice; beyond: singles.

Result<std::shared_ptr<NetCdf>> OpenNetCdf(const std::string& path, const std::string& where) {
  static std::once_flag once;
  std::call_once(once, [] { GDALRegister_netCDF(); });
  constexpr std::array<const char*, 2> kDrivers = {"netCDF", nullptr};
  auto file = std::make_shared<NetCdf>();
  file->where = where;
  file->dataset.reset(GDALOpenEx(path.c_str(), GDAL_OF_MULTIDIM_RASTER | GDAL_OF_READONLY,
                                 kDrivers.data(), nullptr, nullptr));
  if (file->dataset) file->root.reset(GDALDatasetGetRootGroup(file->dataset.get()));
  if (!file->root) {
    const std::string message = QuietErrors::Last("");
    return InputError(where, message.empty() ? "is no NetCDF file" : "cannot be read: " + message,
                      "download or export the file again");
  }
  char** names = GDALGroupGetMDArrayNames(file->root.get(), nullptr);
  for (char** name = names; name != nullptr && *name != nullptr; ++name) {
    file->names.emplace_back(*name);
  }
  CSLDestroy(names);
  return file;
}

/// The curvilinear cells of longitudes and latitudes.
Result<CurvilinearCells> MakeCells(const NetCdfLayout& layout, const FieldChart& chart, int columns,
                                   int rows, const std::vector<double>& heights) {
  std::vector<Vec3> positions;
  positions.reserve(layout.longitudes.size() * heights.size());
  for (const double height : heights) {
    for (std::size_t i = 0; i < layout.longitudes.size(); ++i) {
      positions.push_back(chart.FromFile({layout.longitudes[i], layout.latitudes[i], height}));
    }
  }
  return CurvilinearCells::Create({columns, rows, static_cast<int>(heights.size())},
                                  std::move(positions));
}

}  // namespace

tl::unexpected<Error> DamagedNetCdf(const std::string& where) {
  return InputError(where, "is damaged: " + QuietErrors::Last("cannot be read"),
                    "download or export the file again");
}

Result<FlowFile> ReadNetCdfFlow(const std::string& path, const std::string& where,
                                const FlowFileOptions& options) {
  const QuietErrors quiet;
  PLEINAIR_ASSIGN_OR_RETURN(const std::shared_ptr<NetCdf> file, OpenNetCdf(path, where));
  PLEINAIR_ASSIGN_OR_RETURN(Components found, FindComponents(*file, options));
  auto components = std::make_shared<Components>(std::move(found));
  const GdalArray& east = *components->array[0];
  std::array<double, 3> factor{1.0, 1.0, 1.0};
  std::vector<std::string> warnings;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!components->array[c]) continue;
    const std::string unit = components->array[c]->Unit();
    const auto metres = unit.empty() ? std::optional<double>(1.0) : MetresPerSecond(unit);
    if (!metres) {
      return InputError(where,
                        "the unit of " + components->array[c]->name() + " is \"" +
                            unit.substr(0, 40) + "\", which is not known",
                        std::string("convert it to one of ") + kVelocityUnits);
    }
    if (unit.empty()) {
      warnings.push_back(components->array[c]->name() + " states no unit; taken for m s-1");
    }
    factor[c] = *metres;
  }
  PLEINAIR_ASSIGN_OR_RETURN(const NetCdfLayout layout, ReadLayout(*file, east));
  const std::vector<ArrayDimension>& dimensions = east.dimensions();

  FieldChart chart;
  double half_width_deg = 0.0;
  if (layout.geographic && !layout.longitudes.empty()) {
    // Longitudes around the first; latitudes by their extremes.
    double low = 0.0, high = 0.0;
    for (const double longitude : layout.longitudes) {
      const double off = std::remainder(longitude - layout.longitudes.front(), 360.0);
      low = std::min(low, off);
      high = std::max(high, off);
    }
    const auto [south, north] =
        std::minmax_element(layout.latitudes.begin(), layout.latitudes.end());
    chart = FieldChart::Geographic(layout.longitudes.front() + 0.5 * (low + high),
                                   0.5 * (*south + *north));
    half_width_deg = 0.5 * std::max(high - low, *north - *south);
  } else if (layout.geographic) {
    chart = FieldChart::Geographic(MiddleOf(layout.axes[0]), MiddleOf(layout.axes[1]));
    half_width_deg = std::max(HalfWidthOf(layout.axes[0]), HalfWidthOf(layout.axes[1]));
  } else {
    const StatedCrs stated = east.Crs();
    const std::string crs =
        !options.crs.empty() && options.crs != "marker" ? options.crs : stated.text;
    if (!crs.empty() && options.crs != "marker") chart = FieldChart::Projected(crs);
  }
  const Vec3 unit =
      chart.FromFile({chart.middle().longitude_deg + 1.0, chart.middle().latitude_deg + 1.0, 0.0});
  std::array<FieldAxis, 3> axes;
  std::array<std::size_t, 3> strides{};
  CurvilinearCells cells;
  for (std::size_t a = 0; a < 3; ++a) {
    const bool degrees = layout.geographic && a < 2;
    const double middle = !degrees ? 0.0
                          : a == 0 ? chart.middle().longitude_deg
                                   : chart.middle().latitude_deg;
    const double scale = !degrees ? 1.0 : (a == 0 ? unit.x : unit.y);
    SourceAxis axis = layout.axes[a];
    if (!layout.longitudes.empty() && a < 2) {
      axis.nodes.resize(dimensions[*layout.dimension[a]].size);
      std::iota(axis.nodes.begin(), axis.nodes.end(), 0.0);
      axis.longitude = false;
    }
    PLEINAIR_ASSIGN_OR_RETURN(axes[a], MakeFieldAxis(axis, middle, scale, layout.names[a]));
    if (!layout.dimension[a]) continue;
    strides[a] = 1;
    for (std::size_t d = *layout.dimension[a] + 1; d < dimensions.size(); ++d) {
      if (layout.time_dimension != d) strides[a] *= dimensions[d].size;
    }
  }
  if (!layout.longitudes.empty()) {
    std::vector<double> heights;
    for (int k = 0; k < axes[2].axis.count(); ++k) heights.push_back(axes[2].axis.Node(k));
    PLEINAIR_ASSIGN_OR_RETURN(
        cells, MakeCells(layout, chart, axes[0].axis.count(), axes[1].axis.count(), heights));
  }
  auto grid = std::make_shared<ComponentGrid>(std::move(axes), strides, std::move(cells), chart);
  if (chart.kind() == ChartKind::kProjected && IsTrueEast(components->standard_name)) {
    const Box box = grid->grid().Bounds();
    PLEINAIR_ASSIGN_OR_RETURN(GridConvergence convergence,
                              GridConvergence::Create(chart.crs(), {box.min.x, box.min.y},
                                                      {box.max.x, box.max.y}, where));
    grid->TurnFromEast(std::move(convergence));
  }
  const bool in_double =
      east.is_double() && grid->grid().nodes() <= kMaxDoubleBytes / (3 * sizeof(double));
  const auto read = [file, components, grid, factor, in_double,
                     time_dimension =
                         layout.time_dimension](std::size_t time) -> Result<FieldSlice> {
    const QuietErrors quiet_read;
    std::array<std::vector<double>, 3> values;
    std::array<const std::vector<double>*, 3> pointers{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (!components->array[c]) continue;
      std::vector<std::size_t> start, count;
      for (std::size_t d = 0; d < components->array[c]->dimensions().size(); ++d) {
        start.push_back(time_dimension == d ? time : 0);
        count.push_back(time_dimension == d ? 1 : components->array[c]->dimensions()[d].size);
      }
      auto read_values = components->array[c]->Read(start, count);
      if (!read_values) return DamagedNetCdf(file->where);
      for (double& value : *read_values) value *= factor[c];
      values[c] = std::move(*read_values);
      pointers[c] = &values[c];
    }
    return grid->Combine(pointers, in_double);
  };
  PLEINAIR_ASSIGN_OR_RETURN(FlowFile flow, MakeFlowFile(grid, layout.times, read, chart, options));
  for (const auto& array : components->array) {
    if (array) flow.arrays.push_back(array->name());
  }
  flow.unit = east.Unit();
  flow.first_time = layout.first_time;
  flow.half_width_deg = half_width_deg;
  flow.warnings = std::move(warnings);
  return flow;
}

}  // namespace pleinair::content
