#include "app/sky/sky_directions.h"

#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/sky/sky_picture.h"
#include "base/units.h"
#include "files/csv.h"
#include "files/result_file.h"

namespace pleinair::app {
namespace {

constexpr std::string_view kHeaderHelp = "start it with the line azimuth_deg,elevation_deg";

/// A column of a row with its valid range.
struct AngleColumn {
  const char* name;
  double lowest, highest;
};
constexpr AngleColumn kAzimuth{"azimuth_deg", -360.0, 360.0};
constexpr AngleColumn kElevation{"elevation_deg", -90.0, 90.0};

Result<std::size_t> RequireColumn(const files::CsvReader& header, const AngleColumn& column) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::size_t> found, header.FindColumn(column.name));
  if (found) return *found;
  return InputError(header.Where(), std::string("the column ") + column.name + " is missing",
                    std::string(kHeaderHelp));
}

Result<double> ReadAngle(const files::CsvReader& record, std::size_t at,
                         const AngleColumn& column) {
  const std::string& text = record.fields()[at];
  const std::optional<double> value = files::ParseNumber(text);
  if (value && *value >= column.lowest && *value <= column.highest) return *value;
  return InputError(record.Where(),
                    std::string(column.name) + " \"" + text.substr(0, 40) + "\" is not possible",
                    fmt::format("give degrees from {:g} to {:g}", column.lowest, column.highest));
}

}  // namespace

Result<SkyDirectionTable> ParseSkyDirections(std::string_view text, const std::string& name) {
  files::CsvReader records(text, name);
  PLEINAIR_ASSIGN_OR_RETURN(const bool has_header, records.Next());
  if (!has_header) return InputError(name, "is empty", std::string(kHeaderHelp));
  SkyDirectionTable table;
  table.header = records.record();
  const std::size_t columns = records.fields().size();
  PLEINAIR_ASSIGN_OR_RETURN(const std::size_t azimuth, RequireColumn(records, kAzimuth));
  PLEINAIR_ASSIGN_OR_RETURN(const std::size_t elevation, RequireColumn(records, kElevation));
  while (true) {
    PLEINAIR_ASSIGN_OR_RETURN(const bool more, records.Next());
    if (!more) return table;
    PLEINAIR_RETURN_IF_ERROR(records.CheckFieldCount(columns));
    SkyDirectionRow row;
    row.text = records.record();
    PLEINAIR_ASSIGN_OR_RETURN(row.azimuth_deg, ReadAngle(records, azimuth, kAzimuth));
    PLEINAIR_ASSIGN_OR_RETURN(row.elevation_deg, ReadAngle(records, elevation, kElevation));
    table.rows.push_back(row);
  }
}

Result<void> WriteSkyDirections(const sky::SkyModel& sky, double ground_albedo,
                                const std::string& csv, const std::string& output, bool json) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, files::ReadTextFile(csv));
  PLEINAIR_ASSIGN_OR_RETURN(const SkyDirectionTable table,
                            ParseSkyDirections(text, files::TextFileName(csv)));
  PLEINAIR_ASSIGN_OR_RETURN(files::ResultFile file, files::ResultFile::Open(output));
  std::ostream& out = file.stream();
  if (!json) out << table.header << ",luminance_cd_m2,x,y,r,g,b\n";
  const LinearRgb ground = GroundRadiance(sky, ground_albedo);
  for (const SkyDirectionRow& row : table.rows) {
    const double azimuth = FromDegrees(row.azimuth_deg).value();
    const double elevation = FromDegrees(row.elevation_deg).value();
    const Direction<World> direction{{std::cos(elevation) * std::sin(azimuth),
                                      std::cos(elevation) * std::cos(azimuth),
                                      std::sin(elevation)}};
    const bool is_sky = row.elevation_deg >= 0.0;
    const sky::XyY light = is_sky ? sky.At(direction) : sky::XyYFromRgb(ground);
    const LinearRgb rgb = is_sky ? sky.SkyRadiance(direction) : ground;
    if (json) {
      out << fmt::format(
          R"({{"azimuth_deg":{:.9g},"elevation_deg":{:.9g},"luminance_cd_m2":{:.7g},"x":{:.6f},)"
          R"("y":{:.6f},"r":{:.7g},"g":{:.7g},"b":{:.7g}}})"
          "\n",
          row.azimuth_deg, row.elevation_deg, light.luminance, light.x, light.y, rgb.r, rgb.g,
          rgb.b);
    } else {
      out << fmt::format("{},{:.7g},{:.6f},{:.6f},{:.7g},{:.7g},{:.7g}\n", row.text,
                         light.luminance, light.x, light.y, rgb.r, rgb.g, rgb.b);
    }
  }
  return file.Finish();
}

}  // namespace pleinair::app
