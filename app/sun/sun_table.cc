#include "app/sun/sun_table.h"

#include <array>
#include <cstdio>
#include <optional>
#include <utility>

#include "files/csv.h"

namespace pleinair::app {
namespace {

constexpr std::size_t kRequiredFields = 2;  // Latitude and longitude.

}  // namespace

Result<void> SetObserverField(const ObserverField& field, std::string_view text,
                              const std::string& where, sky::Observer* observer) {
  const std::optional<double> value = files::ParseNumber(text);
  if (!value || *value < field.lowest || *value > field.highest) {
    std::array<char, 96> range;
    std::snprintf(range.data(), range.size(), "give a number from %g to %g (%s)", field.lowest,
                  field.highest, field.unit);
    return InputError(
        where,
        std::string(field.name) + " \"" + std::string(text.substr(0, 40)) + "\" is not possible",
        range.data());
  }
  field.set(*observer, *value);
  return {};
}

Result<SunTable> ParseSunTable(std::string_view text, const std::string& name,
                               const sky::Observer& defaults) {
  files::CsvReader reader(text, name);
  PLEINAIR_ASSIGN_OR_RETURN(const bool has_header, reader.Next());
  constexpr const char* kHeaderHelp =
      "start it with the line utc,lat,lon or utc,lat,lon,height_m,pressure_mbar,temperature_c";
  if (!has_header) return InputError(name, "is empty", kHeaderHelp);
  SunTable table;
  table.header = reader.record();
  const std::size_t columns = reader.fields().size();
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::size_t> time_column, reader.FindColumn("utc"));
  if (!time_column) return InputError(reader.Where(), "the column utc is missing", kHeaderHelp);
  std::vector<std::pair<std::size_t, const ObserverField*>> field_columns;
  for (std::size_t i = 0; i < kObserverFields.size(); ++i) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::size_t> column,
                              reader.FindColumn(kObserverFields[i].name));
    if (column) {
      field_columns.emplace_back(*column, &kObserverFields[i]);
    } else if (i < kRequiredFields) {
      return InputError(reader.Where(),
                        std::string("the column ") + kObserverFields[i].name + " is missing",
                        kHeaderHelp);
    }
  }
  while (true) {
    PLEINAIR_ASSIGN_OR_RETURN(const bool more, reader.Next());
    if (!more) return table;
    PLEINAIR_RETURN_IF_ERROR(reader.CheckFieldCount(columns));
    SunTableRow row;
    row.text = reader.record();
    row.observer = defaults;
    Result<UtcTime> time = UtcTime::Parse(files::Trimmed(reader.fields()[*time_column]));
    if (!time) {
      Error error = std::move(time).error();
      error.where = reader.Where();
      return tl::make_unexpected(std::move(error));
    }
    row.time = *time;
    for (const auto& [column, field] : field_columns) {
      const std::string& value = reader.fields()[column];
      const bool required = field < &kObserverFields[kRequiredFields];
      if (!required && files::Trimmed(value).empty()) continue;
      PLEINAIR_RETURN_IF_ERROR(SetObserverField(*field, value, reader.Where(), &row.observer));
    }
    table.rows.push_back(row);
  }
}

}  // namespace pleinair::app
