#include "app/output/light_csv_file.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "files/csv.h"

namespace pleinair::app {
namespace {

using Source = compositor::FrameLight::Source;

constexpr std::array<const char*, 10> kColumns = {
    "frame", "timestamp_s",      "sun_r", "sun_g", "sun_b", "sky_r", "sky_g",
    "sky_b", "sun_to_sky_error", "source"};
constexpr std::size_t kSourceColumn = 9;
constexpr const char* kRemedy = "give the light.csv of a replay as it was written";

Result<Source> SourceNamed(const std::string& text, const std::string& where) {
  for (const Source source :
       {Source::kSurfaces, Source::kColors, Source::kTotalOnly, Source::kStated, Source::kHeld}) {
    if (text == LightSourceName(source)) return source;
  }
  return InputError(where, "the source \"" + text.substr(0, 40) + "\" is unknown", kRemedy);
}

}  // namespace

Result<std::vector<LightRow>> ParseLightCsv(std::string_view text, const std::string& name) {
  files::CsvReader records(text, name);
  PLEINAIR_ASSIGN_OR_RETURN(const bool has_header, records.Next());
  if (!has_header) return InputError(name, "is empty", kRemedy);
  const std::size_t columns = records.fields().size();
  std::array<std::size_t, kColumns.size()> places{};
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::size_t> place,
                              records.FindColumn(kColumns[i]));
    if (!place) {
      return InputError(records.Where(), std::string("the column ") + kColumns[i] + " is missing",
                        kRemedy);
    }
    places[i] = *place;
  }
  std::vector<LightRow> rows;
  while (true) {
    PLEINAIR_ASSIGN_OR_RETURN(const bool more, records.Next());
    if (!more) return rows;
    PLEINAIR_RETURN_IF_ERROR(records.CheckFieldCount(columns));
    std::array<double, kSourceColumn> values{};
    for (std::size_t i = 0; i < kSourceColumn; ++i) {
      constexpr double kMost = 1e9;
      const std::optional<double> value = files::ParseNumber(records.fields()[places[i]]);
      if (!value || *value < 0.0 || *value > kMost) {
        return InputError(records.Where(), std::string(kColumns[i]) + " is not a possible number",
                          kRemedy);
      }
      values[i] = *value;
    }
    PLEINAIR_ASSIGN_OR_RETURN(
        const Source source, SourceNamed(records.fields()[places[kSourceColumn]], records.Where()));
    const auto timestamp_ns = static_cast<std::int64_t>(std::llround(1e9 * values[1]));
    if (!rows.empty() && timestamp_ns <= rows.back().timestamp_ns) {
      return InputError(records.Where(), "the time does not rise", kRemedy);
    }
    rows.push_back({static_cast<std::int64_t>(values[0]),
                    timestamp_ns,
                    {values[2], values[3], values[4]},
                    {values[5], values[6], values[7]},
                    values[8],
                    source});
  }
}

}  // namespace pleinair::app
