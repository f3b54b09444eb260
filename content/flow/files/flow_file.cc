#include "content/flow/files/flow_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>

#include "content/flow/files/field_source.h"

namespace pleinair::content {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFlowKinds =
    "give NetCDF (.nc), GRIB (.grb, .grib2), a GeoTIFF of two or three bands, or a VTK file (.vti, "
    ".vtr, .vts, .vtk)";

template <typename T>
bool HasFinite(const std::vector<T>& values) {
  return std::any_of(values.begin(), values.end(), [](T value) { return std::isfinite(value); });
}

Result<void> CheckHasFlow(const GridField& field, const std::string& where) {
  const std::size_t times = std::max<std::size_t>(1, field.times().size());
  for (std::size_t i = 0; i < times; ++i) {
    const Seconds time = field.times().empty() ? 0.0 : field.times()[i];
    PLEINAIR_ASSIGN_OR_RETURN(const FieldWindow window, field.FrozenAt(time));
    if (HasFinite(window.first->singles) || HasFinite(window.first->doubles)) return {};
  }
  return InputError(where, "has no velocity that is a number",
                    "check the fill value and the names of the components");
}

}  // namespace

Result<FlowFile> ReadFlowFile(const fs::path& file, const FlowFileOptions& options) {
  const std::string where = file.string();
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return InputError(where, fs::exists(file, error) ? "is not a regular file" : "does not exist",
                      kFlowKinds);
  }
  if (options.u.empty() != options.v.empty() || (options.u.empty() && !options.w.empty())) {
    return InputError(where, "one component of the velocity is named alone",
                      "give --u and --v together, and --w with them");
  }
  // An absolute name has no prefix of another kind of source.
  const std::string path = fs::absolute(file, error).string();
  if (path.starts_with("/vsi")) return InputError(where, "is no file on a disk", kFlowKinds);
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto is = [&](std::initializer_list<const char*> endings) {
    return std::any_of(endings.begin(), endings.end(),
                       [&](const char* each) { return ending == each; });
  };
  auto read = [&]() -> Result<FlowFile> {
    if (is({".vti", ".vtr", ".vts", ".vtk", ".vtu", ".vtp", ".pvti", ".pvtr", ".pvts", ".pvd"})) {
      return ReadVtkFlow(path, where, options);
    }
    if (is({".nc", ".nc4", ".cdf", ".netcdf"})) return ReadNetCdfFlow(path, where, options);
    if (is({".tif", ".tiff", ".grb", ".grb2", ".grib", ".grib2"})) {
      return ReadBandsFlow(path, where, options);
    }
    return InputError(where, "is no file of velocities by its ending", kFlowKinds);
  }();
  if (!read) {
    Error failure = std::move(read).error();
    if (failure.where.empty()) failure.where = where;
    return tl::make_unexpected(std::move(failure));
  }
  PLEINAIR_RETURN_IF_ERROR(CheckHasFlow(*read->field, where));
  return read;
}

}  // namespace pleinair::content
