#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "sky/sky_model.h"

namespace pleinair::app {

/// A row of a table of directions, and its own text to repeat.
struct SkyDirectionRow {
  double azimuth_deg = 0.0;    ///< −360…360.
  double elevation_deg = 0.0;  ///< −90…90.
  std::string_view text;       ///< Into the table's text, without its line end.
};

/// A parsed CSV table of directions. Its rows point into the text it was read from.
struct SkyDirectionTable {
  std::string_view header;
  std::vector<SkyDirectionRow> rows;
};

/// Parses `azimuth_deg,elevation_deg`: columns by name in any order, others are left alone. `name`
/// is the file's, for errors, which say the line. `text` must outlive the table.
Result<SkyDirectionTable> ParseSkyDirections(std::string_view text, const std::string& name);

/// Reads a CSV file with the columns azimuth_deg and elevation_deg (others are kept; "-" is
/// standard input) and writes each row with luminance_cd_m2,x,y,r,g,b behind it: of the sky without
/// the sun's disc, below the horizon of the ground of `ground_albedo`. An object a line with
/// `json`. `output` empty: standard output. Errors: the file's with the line, nothing is written
/// then; as WriteError.
Result<void> WriteSkyDirections(const sky::SkyModel& sky, double ground_albedo,
                                const std::string& csv, const std::string& output, bool json);

}  // namespace pleinair::app
