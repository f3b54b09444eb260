#include "app/sky/shadow_points.h"

#include <iostream>
#include <optional>

#include <fmt/format.h>

#include "base/parallel_for.h"
#include "files/csv.h"
#include "files/result_file.h"

namespace pleinair::app {
namespace {

constexpr const char* kPointsHelp =
    "start it with the line east_m,north_m or east_m,north_m,height_m,seconds";

struct PointColumn {
  const char* name;
  double lowest, highest;
  bool required;
  const char* unit;
};
constexpr PointColumn kPointColumns[] = {{"east_m", -1e6, 1e6, true, "metres"},
                                         {"north_m", -1e6, 1e6, true, "metres"},
                                         {"height_m", -1e4, 3e4, false, "metres"},
                                         {"seconds", -1e7, 1e7, false, "seconds"}};

Result<double> ReadPointNumber(const files::CsvReader& record, std::size_t at,
                               const PointColumn& column) {
  const std::string& text = record.fields()[at];
  const std::optional<double> value = files::ParseNumber(text);
  if (value && *value >= column.lowest && *value <= column.highest) return *value;
  return InputError(
      record.Where(), std::string(column.name) + " \"" + text.substr(0, 40) + "\" is not possible",
      fmt::format("give {} from {:g} to {:g}", column.unit, column.lowest, column.highest));
}

}  // namespace

Result<ShadowPointTable> ParseShadowPoints(std::string_view text, const std::string& name,
                                           double seconds) {
  files::CsvReader records(text, name);
  PLEINAIR_ASSIGN_OR_RETURN(const bool has_header, records.Next());
  if (!has_header) return InputError(name, "is empty", kPointsHelp);
  ShadowPointTable table;
  table.header = records.record();
  const std::size_t columns = records.fields().size();
  std::optional<std::size_t> places[4];
  for (std::size_t i = 0; i < 4; ++i) {
    PLEINAIR_ASSIGN_OR_RETURN(places[i], records.FindColumn(kPointColumns[i].name));
    if (!places[i] && kPointColumns[i].required) {
      return InputError(records.Where(),
                        std::string("the column ") + kPointColumns[i].name + " is missing",
                        kPointsHelp);
    }
  }
  while (true) {
    PLEINAIR_ASSIGN_OR_RETURN(const bool more, records.Next());
    if (!more) return table;
    PLEINAIR_RETURN_IF_ERROR(records.CheckFieldCount(columns));
    double values[4] = {0.0, 0.0, 0.0, seconds};
    for (std::size_t i = 0; i < 4; ++i) {
      if (!places[i]) continue;
      PLEINAIR_ASSIGN_OR_RETURN(values[i], ReadPointNumber(records, *places[i], kPointColumns[i]));
    }
    table.rows.push_back({{values[0], values[1], values[2]}, values[3], records.record()});
  }
}

Result<void> WriteCloudShadow(const LayeredSky& skies, const SkyMoment& moment,
                              const std::string& csv, const std::string& output, bool json) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, files::ReadTextFile(csv));
  PLEINAIR_ASSIGN_OR_RETURN(
      const ShadowPointTable table,
      ParseShadowPoints(text, files::TextFileName(csv), skies.SecondsAt(moment)));
  PLEINAIR_ASSIGN_OR_RETURN(files::ResultFile file, files::ResultFile::Open(output));
  const auto clear = skies.ClearAt(moment);
  const Direction<World> to_sun = clear->ToSun();
  const double clear_lx = Luminance(clear->SunNormalIrradiance());
  if (to_sun.xyz.z <= 0.0) {
    std::cerr << "pleinair: the sun is below the horizon: no light reaches the points\n";
  }
  std::vector<double> transmittances(table.rows.size());
  ParallelForBlocks(table.rows.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      transmittances[i] = clouds::SunTransmittance(skies.fields(), table.rows[i].place_m, to_sun,
                                                   table.rows[i].seconds);
    }
  });
  std::ostream& out = file.stream();
  if (!json) out << table.header << ",sun_transmittance,sun_normal_lux\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const ShadowPointRow& row = table.rows[i];
    if (json) {
      out << fmt::format(R"({{"east_m":{:.9g},"north_m":{:.9g},"height_m":{:.9g},"seconds":{:.9g},)"
                         R"("sun_transmittance":{:.7g},"sun_normal_lux":{:.7g}}})"
                         "\n",
                         row.place_m.x, row.place_m.y, row.place_m.z, row.seconds,
                         transmittances[i], transmittances[i] * clear_lx);
    } else {
      out << fmt::format("{},{:.7g},{:.7g}\n", row.text, transmittances[i],
                         transmittances[i] * clear_lx);
    }
  }
  return file.Finish();
}

}  // namespace pleinair::app
