#pragma once

#include <string>

#include "base/error.h"
#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::app {

/// The columns that every row gets, in this order.
inline constexpr const char* kSunColumns =
    "azimuth_deg,elevation_deg,elevation_refracted_deg,distance_au";

/// The members of a JSON object that say where the sun stood, without the braces.
std::string SunPositionJson(UtcTime time, const sky::Observer& observer,
                            const sky::SunPosition& sun);

/// Where and how rows are written.
struct SunRowsOptions {
  sky::SunModel model = sky::SunModel::kPrecise;
  bool json = false;   ///< An object a line instead of CSV.
  std::string output;  ///< Empty: standard output.
};

/// Each row of a CSV file (app/sun/sun_table.h; "-" is standard input) with the sun's columns
/// behind it. Errors: the file's, with the line; nothing is written then.
Result<void> WriteSunTable(const std::string& csv, const sky::Observer& defaults,
                           const SunRowsOptions& options);

/// A row every `step_s` seconds from `from` to `until`, both included. Errors (input): `until`
/// lies before `from`, a step that is no positive number, more than ten million rows.
Result<void> WriteSunSeries(const sky::Observer& observer, UtcTime from, UtcTime until,
                            double step_s, const SunRowsOptions& options);

}  // namespace pleinair::app
