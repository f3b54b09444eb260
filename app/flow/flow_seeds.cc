#include "app/flow/flow_seeds.h"

#include <array>
#include <optional>

#include "files/csv.h"
#include "files/text_file.h"

namespace pleinair::app {
namespace {

constexpr std::size_t kMaxSeedBytes = std::size_t{256} << 20;

/// Coordinates of a field in the plane along its flat axis.
Vec3 OnPlane(Vec3 point, const content::GridField& field) {
  const auto& grid = field.grid();
  if (!grid.cells.empty()) {
    if (!grid.axes[2].flat()) return point;
    return {point.x, point.y, grid.Node(0, 0, 0).z};
  }
  if (grid.axes[0].flat()) point.x = grid.axes[0].first_m();
  if (grid.axes[1].flat()) point.y = grid.axes[1].first_m();
  if (grid.axes[2].flat()) point.z = grid.axes[2].first_m();
  return point;
}

}  // namespace

Result<std::vector<content::Seed>> ReadSeeds(const std::string& file, const content::FlowFile& flow,
                                             content::Seconds start_s) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, files::ReadWholeFile(file, kMaxSeedBytes));
  files::CsvReader csv(text, file);
  PLEINAIR_ASSIGN_OR_RETURN(const bool has_header, csv.Next());
  const bool geographic = flow.chart.kind() == content::ChartKind::kGeographic;
  const std::array<const char*, 4> names{geographic ? "lon" : "x", geographic ? "lat" : "y", "z",
                                         "t"};
  const std::string wanted = geographic ? "give the header lon,lat or lon,lat,z in degrees"
                                        : "give the header x,y or x,y,z in the file's coordinates";
  std::array<std::optional<std::size_t>, 4> columns;
  for (std::size_t i = 0; has_header && i < 4; ++i) {
    PLEINAIR_ASSIGN_OR_RETURN(columns[i], csv.FindColumn(names[i]));
  }
  if (!columns[0] || !columns[1]) {
    return InputError(csv.Where(), "has no columns of places", wanted);
  }
  if (flow.has_heights && !columns[2]) {
    return InputError(csv.Where(), "has no column z, but the file has heights",
                      "add the column z, metres");
  }
  const std::size_t count = csv.fields().size();
  std::vector<content::Seed> seeds;
  for (;;) {
    PLEINAIR_ASSIGN_OR_RETURN(const bool has_row, csv.Next());
    if (!has_row) break;
    PLEINAIR_RETURN_IF_ERROR(csv.CheckFieldCount(count));
    std::array<double, 4> values{0.0, 0.0, 0.0, start_s};
    for (std::size_t i = 0; i < 4; ++i) {
      if (!columns[i]) continue;
      const auto number = files::ParseNumber(csv.fields()[*columns[i]]);
      if (!number) {
        return InputError(csv.Where(), std::string("column ") + names[i] + " has no number",
                          "repair that line");
      }
      values[i] = *number;
    }
    if (seeds.size() == kMaxSeeds) {
      return InputError(csv.Where(), "more than 2,000,000 seeds", "use fewer seeds");
    }
    const Vec3 point = flow.chart.FromFile({values[0], values[1], values[2]});
    seeds.push_back({OnPlane(point, *flow.field), values[3]});
  }
  if (seeds.empty()) return InputError(file, "has no seeds", wanted);
  return seeds;
}

}  // namespace pleinair::app
