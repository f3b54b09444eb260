#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "content/flow/files/cf_time.h"
#include "content/flow/files/netcdf_file.h"
#include "content/flow/files/velocity_units.h"

namespace pleinair::content {
namespace {

constexpr std::size_t kMaxAxisNodes = 1 << 20;

enum class Role { kX, kY, kZ, kTime, kNone };

bool Contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// By the attributes of the coordinate, else the kind or name of the dimension.
Role RoleOf(const ArrayDimension& dimension, const GdalArray* coordinate) {
  std::string axis, standard, unit;
  if (coordinate != nullptr) {
    axis = coordinate->Text("axis");
    standard = coordinate->Text("standard_name");
    unit = coordinate->Unit();
  }
  if (axis == "T" || standard == "time" || Contains(unit, " since ")) return Role::kTime;
  if (axis == "X" || Contains(standard, "longitude") || standard == "projection_x_coordinate" ||
      unit.starts_with("degrees_e") || unit.starts_with("degree_e")) {
    return Role::kX;
  }
  if (axis == "Y" || Contains(standard, "latitude") || standard == "projection_y_coordinate" ||
      unit.starts_with("degrees_n") || unit.starts_with("degree_n")) {
    return Role::kY;
  }
  if (axis == "Z" || standard == "height" || standard == "depth" || standard == "altitude") {
    return Role::kZ;
  }
  std::string name = dimension.name.substr(dimension.name.rfind('/') + 1);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto is = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* each) { return name == each; });
  };
  if (is({"x", "lon", "longitude", "easting"})) return Role::kX;
  if (is({"y", "lat", "latitude", "northing"})) return Role::kY;
  if (is({"z", "height", "depth", "lev", "level", "altitude", "isobaric", "pressure"})) {
    return Role::kZ;
  }
  if (is({"time", "t"})) return Role::kTime;
  // What GDAL concludes, which guesses where attributes are missing.
  if (dimension.type == "HORIZONTAL_X") return Role::kX;
  if (dimension.type == "HORIZONTAL_Y") return Role::kY;
  if (dimension.type == "VERTICAL") return Role::kZ;
  if (dimension.type == "TEMPORAL") return Role::kTime;
  return Role::kNone;
}

Result<void> ReadTimes(const NetCdf& file, const GdalArray& coordinate, NetCdfLayout* layout) {
  const auto values = coordinate.ReadAll();
  if (!values) return DamagedNetCdf(file.where);
  const auto unit = ParseCfTimeUnit(coordinate.Unit());
  const double seconds = unit ? unit->seconds : 1.0;
  for (const double value : *values) {
    if (!std::isfinite(value)) {
      return InputError(file.where, "a time is no number", "repair the times of the file");
    }
    layout->times.push_back((value - values->front()) * seconds);
  }
  if (unit && unit->since && !values->empty()) {
    layout->first_time = unit->since->PlusSeconds(values->front() * seconds);
  }
  return {};
}

/// Longitudes and latitudes of every point, by the attribute `coordinates`.
Result<bool> ReadCurvilinear(const NetCdf& file, const GdalArray& array, NetCdfLayout* layout) {
  const std::string text = array.Text("coordinates");
  std::optional<GdalArray> lon, lat;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    auto each = file.Open(text.substr(at, end - at));
    at = end + 1;
    if (!each || each->dimensions().size() != 2 || !IsDegrees(each->Unit())) continue;
    const std::string standard = each->Text("standard_name"), unit = each->Unit();
    if (Contains(standard, "longitude") || unit.starts_with("degrees_e")) {
      lon = std::move(each);
    } else if (Contains(standard, "latitude") || unit.starts_with("degrees_n")) {
      lat = std::move(each);
    }
  }
  if (!lon || !lat || !SameDimensions(*lon, *lat)) return false;
  for (std::size_t d = 0; d < array.dimensions().size(); ++d) {
    const std::string& name = array.dimensions()[d].name;
    if (name == lon->dimensions()[1].name) layout->dimension[0] = d;
    if (name == lon->dimensions()[0].name) layout->dimension[1] = d;
  }
  if (!layout->dimension[0] || !layout->dimension[1]) return false;
  auto longitudes = lon->ReadAll(), latitudes = lat->ReadAll();
  if (!longitudes || !latitudes) return DamagedNetCdf(file.where);
  layout->longitudes = std::move(*longitudes);
  layout->latitudes = std::move(*latitudes);
  layout->geographic = true;
  return true;
}

}  // namespace

Result<NetCdfLayout> ReadLayout(const NetCdf& file, const GdalArray& array) {
  NetCdfLayout layout;
  PLEINAIR_ASSIGN_OR_RETURN(const bool curvilinear, ReadCurvilinear(file, array, &layout));
  for (std::size_t d = 0; d < array.dimensions().size(); ++d) {
    const ArrayDimension& dimension = array.dimensions()[d];
    const auto coordinate = file.Open(dimension.name);
    const bool has_nodes = coordinate && coordinate->dimensions().size() == 1;
    if (curvilinear && (layout.dimension[0] == d || layout.dimension[1] == d)) continue;
    const Role role = RoleOf(dimension, has_nodes ? &*coordinate : nullptr);
    if (role == Role::kTime && !layout.time_dimension) {
      layout.time_dimension = d;
      if (has_nodes) PLEINAIR_RETURN_IF_ERROR(ReadTimes(file, *coordinate, &layout));
      if (has_nodes || dimension.size == 1) continue;
    }
    if (role == Role::kNone || role == Role::kTime ||
        layout.dimension[static_cast<std::size_t>(role)] || !has_nodes) {
      if (dimension.size == 1) continue;
      return InputError(file.where,
                        "the dimension \"" + dimension.name + "\" of " + array.name() + " has " +
                            std::to_string(dimension.size) +
                            " values and no coordinate in space or time",
                        "choose one of its values, for example with ncks -d " + dimension.name +
                            ",0 of the package nco");
    }
    const auto a = static_cast<std::size_t>(role);
    if (dimension.size > kMaxAxisNodes) {
      return InputError(file.where, "the dimension \"" + dimension.name + "\" is too long",
                        "cut out what lies near the marker");
    }
    auto nodes = coordinate->ReadAll();
    if (!nodes) return DamagedNetCdf(file.where);
    const std::string unit = coordinate->Unit();
    if (a < 2) {
      layout.geographic = layout.geographic || IsDegrees(unit);
      layout.axes[a].longitude = a == 0 && IsDegrees(unit);
    }
    if (!IsDegrees(unit) || a == 2) {
      const auto metres = unit.empty() || unit == "1" ? std::optional<double>(1.0) : MetresOf(unit);
      if (!metres && dimension.size == 1) continue;
      if (!metres) {
        return InputError(file.where,
                          "the coordinate \"" + dimension.name + "\" is in " + unit.substr(0, 30) +
                              ", which is no length",
                          "choose one of its values, for example with ncks -d " + dimension.name +
                              ",0 of the package nco");
      }
      const bool down = a == 2 && (coordinate->Text("positive") == "down" ||
                                   coordinate->Text("standard_name") == "depth");
      for (double& node : *nodes) node *= down ? -*metres : *metres;
    }
    layout.dimension[a] = d;
    layout.axes[a].nodes = std::move(*nodes);
    layout.names[a] = dimension.name;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    if (!layout.dimension[a] && layout.axes[a].nodes.empty()) layout.axes[a].nodes = {0.0};
  }
  return layout;
}

}  // namespace pleinair::content
