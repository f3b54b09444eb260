#pragma once

#include <string>

#include "base/error.h"
#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::app {

/// Columns of every row, in this order.
inline constexpr const char* kSunColumns =
    "azimuth_deg,elevation_deg,elevation_refracted_deg,distance_au";

/// Members of a JSON object with the sun's position, without the braces.
std::string SunPositionJson(UtcTime time, const sky::Observer& observer,
                            const sky::SunPosition& sun);

/// Format and output of the rows.
struct SunRowsOptions {
  sky::SunModel model = sky::SunModel::kPrecise;
  bool json = false;   ///< One object per line instead of CSV.
  std::string output;  ///< Empty: standard output.
};

/// Appends the sun's columns to each row of a CSV file (app/sun/sun_table.h; "-" is standard
/// input). Errors: those of the file, with the line, before anything is written.
Result<void> WriteSunTable(const std::string& csv, const sky::Observer& defaults,
                           const SunRowsOptions& options);

/// Writes a row every `step_s` seconds from `from` to `until`, both included. Errors (input):
/// `until` is before `from`, a step that is not positive, more than ten million rows.
Result<void> WriteSunSeries(const sky::Observer& observer, UtcTime from, UtcTime until,
                            double step_s, const SunRowsOptions& options);

}  // namespace pleinair::app
