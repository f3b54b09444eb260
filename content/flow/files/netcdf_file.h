#pragma once

// Internal: an open NetCDF file, its components of velocity and their grid.

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/utc_time.h"
#include "content/flow/files/field_source.h"
#include "content/flow/files/flow_file.h"
#include "content/flow/files/gdal_array.h"

namespace pleinair::content {

/// The arrays of a file, open while a field reads from them.
struct NetCdf {
  std::string where;
  Dataset dataset;
  Group root;
  std::vector<std::string> names;

  std::optional<GdalArray> Open(const std::string& name) const {
    return GdalArray::Open(root.get(), name);
  }
};

/// The error of a read that failed.
tl::unexpected<Error> DamagedNetCdf(const std::string& where);

bool SameDimensions(const GdalArray& a, const GdalArray& b);

/// Whether a unit is one of angles.
inline bool IsDegrees(const std::string& unit) { return unit.starts_with("degree"); }

/// The components of a file.
struct Components {
  std::array<std::optional<GdalArray>, 3> array;
  std::string standard_name;  ///< Of the first.
};

/// By the names of the options, else by standard names, else by usual names. Errors (input): none,
/// several, or at different points.
Result<Components> FindComponents(const NetCdf& file, const FlowFileOptions& options);

/// The grid of the components, in the file's order.
struct NetCdfLayout {
  std::array<std::optional<std::size_t>, 3> dimension;  ///< Of x, y and z.
  std::optional<std::size_t> time_dimension;
  std::array<SourceAxis, 3> axes;
  std::array<std::string, 3> names;
  bool geographic = false;
  std::vector<double> longitudes, latitudes;  ///< Of a curvilinear grid, x fastest.
  std::vector<Seconds> times;
  std::optional<UtcTime> first_time;
};

/// Reads the coordinates of an array. Errors (input): damage; a dimension that is no place or time.
Result<NetCdfLayout> ReadLayout(const NetCdf& file, const GdalArray& array);

}  // namespace pleinair::content
