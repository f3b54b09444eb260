#pragma once

// Internal: what the readers of flow files have in common.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/utc_time.h"
#include "content/flow/files/flow_file.h"

namespace pleinair::content {

/// A coordinate axis as the file has it.
struct SourceAxis {
  std::vector<double> nodes;  ///< Metres or degrees, in the file's order.
  bool longitude = false;
};

/// An axis of a field, and how the file's values come to its nodes.
struct FieldAxis {
  GridAxis axis;
  /// By node of the axis: the number of the file's value. A closed axis repeats some.
  std::vector<int> source;
};

/// Sorts an axis ascending, unwraps longitudes and closes the axis of all of them. `offset` and
/// `scale` take nodes to the field's metres: (node − offset) scale. Errors (input, without a
/// place): nodes that are not finite or neither ascend nor descend.
Result<FieldAxis> MakeFieldAxis(const SourceAxis& axis, double offset, double scale,
                                const std::string& name);

/// The unwrapped middle of an axis.
double MiddleOf(const SourceAxis& axis);

/// Half the extent of an axis.
double HalfWidthOf(const SourceAxis& axis);

/// An array of a file, for errors.
struct ArrayNote {
  std::string name, unit;
};

/// "has no velocities": an error that lists the arrays with their units.
tl::unexpected<Error> NoVelocities(const std::string& where, const std::vector<ArrayNote>& arrays);

/// Whether a name says true east or north, as eastward_wind does.
bool IsTrueEast(const std::string& standard_name);

/// The standard name of the partner of a component to the east or along x: eastward_wind gives
/// northward_wind, sea_water_x_velocity gives sea_water_y_velocity. Unset: it is no such component.
std::optional<std::string> NorthPartner(const std::string& standard_name);
/// Of the upward component.
std::optional<std::string> UpPartner(const std::string& standard_name);

Result<FlowFile> ReadNetCdfFlow(const std::string& path, const std::string& where,
                                const FlowFileOptions& options);
Result<FlowFile> ReadBandsFlow(const std::string& path, const std::string& where,
                               const FlowFileOptions& options);
Result<FlowFile> ReadVtkFlow(const std::string& path, const std::string& where,
                             const FlowFileOptions& options);

}  // namespace pleinair::content
