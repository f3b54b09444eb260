#include <algorithm>
#include <array>
#include <utility>

#include "content/flow/files/netcdf_file.h"

namespace pleinair::content {
namespace {

/// Names of pairs that stand for velocities in files without standard names.
constexpr std::array<std::array<const char*, 3>, 7> kUsualNames = {{{"u10", "v10", ""},
                                                                    {"u", "v", "w"},
                                                                    {"U", "V", "W"},
                                                                    {"uo", "vo", "wo"},
                                                                    {"u_wind", "v_wind", ""},
                                                                    {"water_u", "water_v", ""},
                                                                    {"ux", "uy", "uz"}}};

}  // namespace

bool SameDimensions(const GdalArray& a, const GdalArray& b) {
  return a.dimensions().size() == b.dimensions().size() &&
         std::equal(a.dimensions().begin(), a.dimensions().end(), b.dimensions().begin(),
                    [](const ArrayDimension& one, const ArrayDimension& other) {
                      return one.name == other.name && one.size == other.size;
                    });
}

Result<Components> FindComponents(const NetCdf& file, const FlowFileOptions& options) {
  Components found;
  std::vector<ArrayNote> notes;
  std::vector<std::pair<std::string, std::string>> standard_names;  // Of arrays.
  for (const std::string& name : file.names) {
    const auto array = file.Open(name);
    if (!array || !array->is_number()) continue;
    if (array->dimensions().size() >= 2) notes.push_back({name, array->Unit()});
    standard_names.emplace_back(array->Text("standard_name"), name);
  }
  const auto named = [&](const std::string& standard, const GdalArray* like) {
    std::vector<std::string> names;
    for (const auto& [each, name] : standard_names) {
      if (each != standard) continue;
      const auto array = file.Open(name);
      if (array && (like == nullptr || SameDimensions(*array, *like))) names.push_back(name);
    }
    return names;
  };
  std::array<std::string, 3> chosen{options.u, options.v, options.w};
  if (chosen[0].empty()) {
    std::vector<std::array<std::string, 2>> pairs;
    for (const auto& [standard, name] : standard_names) {
      const auto partner = NorthPartner(standard);
      const auto array = file.Open(name);
      if (!partner || !array || array->dimensions().size() < 1) continue;
      for (const std::string& north : named(*partner, &*array)) pairs.push_back({name, north});
    }
    if (pairs.size() > 1) {
      std::string list;
      for (const auto& [u, v] : pairs) list += (list.empty() ? "" : "; ") + u + ", " + v;
      return InputError(file.where, "has several fields of velocities: " + list.substr(0, 400),
                        "choose one with --u and --v");
    }
    if (pairs.size() == 1) {
      chosen[0] = pairs[0][0];
      chosen[1] = pairs[0][1];
    }
    for (const auto& usual : kUsualNames) {
      if (!chosen[0].empty()) break;
      const auto has = [&](const char* name) {
        return std::any_of(notes.begin(), notes.end(),
                           [&](const ArrayNote& note) { return note.name == name; });
      };
      if (!has(usual[0]) || !has(usual[1])) continue;
      chosen = {usual[0], usual[1], has(usual[2]) ? usual[2] : ""};
    }
    if (chosen[0].empty()) return NoVelocities(file.where, notes);
  }
  for (std::size_t c = 0; c < 2; ++c) {
    found.array[c] = file.Open(chosen[c]);
    if (found.array[c] && found.array[c]->is_number()) continue;
    Error error = NoVelocities(file.where, notes).value();
    error.what = "has no array \"" + chosen[c].substr(0, 60) + "\"" +
                 error.what.substr(error.what.find(';'));
    return tl::make_unexpected(std::move(error));
  }
  found.standard_name = found.array[0]->Text("standard_name");
  if (!SameDimensions(*found.array[0], *found.array[1])) {
    return InputError(
        file.where,
        "the components " + chosen[0] + " and " + chosen[1] + " belong to different points",
        "interpolate them to the centres of the cells");
  }
  if (chosen[2].empty()) {
    const auto up = UpPartner(found.standard_name);
    const auto names = up ? named(*up, &*found.array[0]) : std::vector<std::string>{};
    if (names.size() == 1) chosen[2] = names[0];
  }
  if (chosen[2].empty()) return found;
  found.array[2] = file.Open(chosen[2]);
  if (!found.array[2] || !found.array[2]->is_number() ||
      !SameDimensions(*found.array[0], *found.array[2])) {
    if (options.w.empty()) {
      found.array[2].reset();
      return found;
    }
    return InputError(
        file.where,
        "has no array \"" + chosen[2].substr(0, 60) + "\" at the points of " + chosen[0],
        "check --w");
  }
  return found;
}

}  // namespace pleinair::content
