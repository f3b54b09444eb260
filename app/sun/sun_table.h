#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::app {

/// A quantity of an observer in a table or an option, with its valid range.
struct ObserverField {
  const char* name;
  double lowest, highest;
  const char* unit;
  void (*set)(sky::Observer&, double);
};
inline constexpr std::array<ObserverField, 5> kObserverFields = {{
    {"lat", -90.0, 90.0, "degrees, north positive",
     [](sky::Observer& o, double v) { o.latitude = FromDegrees(v); }},
    {"lon", -180.0, 360.0, "degrees, east positive",
     [](sky::Observer& o, double v) { o.longitude = FromDegrees(v); }},
    {"height_m", -11'000.0, 1'000'000.0, "metres",
     [](sky::Observer& o, double v) { o.height = Metres(v); }},
    {"pressure_mbar", 0.0, 1'200.0, "millibar",
     [](sky::Observer& o, double v) { o.pressure_mbar = v; }},
    {"temperature_c", -150.0, 100.0, "degrees Celsius",
     [](sky::Observer& o, double v) { o.temperature_c = v; }},
}};

/// Parses a number into the observer. An error contains `where` and the range.
Result<void> SetObserverField(const ObserverField& field, std::string_view text,
                              const std::string& where, sky::Observer* observer);

/// A row of a table of places and times: the input, and the row's text for the output.
struct SunTableRow {
  UtcTime time;
  sky::Observer observer;
  std::string_view text;  ///< Points into the table's text, without its line end.
};

/// A parsed CSV table of places and times. Its rows point into the text.
struct SunTable {
  std::string_view header;
  std::vector<SunTableRow> rows;
};

/// Parses `utc,lat,lon[,height_m,pressure_mbar,temperature_c]`: columns by name in any order;
/// others are ignored. It accepts a byte order mark, CRLF, quoted fields and blank lines. Empty
/// fields and missing columns take their values from `defaults`. `name` is the file's; errors
/// contain it and the line. `text` must outlive the table.
Result<SunTable> ParseSunTable(std::string_view text, const std::string& name,
                               const sky::Observer& defaults);

}  // namespace pleinair::app
