#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "sky/sky_model.h"

namespace pleinair::app {

/// A row of a table of directions, with its text for the output.
struct SkyDirectionRow {
  double azimuth_deg = 0.0;    ///< −360…360.
  double elevation_deg = 0.0;  ///< −90…90.
  std::string_view text;       ///< Points into the table's text, without its line end.
};

/// A parsed CSV table of directions. Its rows point into the text.
struct SkyDirectionTable {
  std::string_view header;
  std::vector<SkyDirectionRow> rows;
};

/// Parses `azimuth_deg,elevation_deg`: columns by name in any order; others are ignored. `name` is
/// the file's; errors contain it and the line. `text` must outlive the table.
Result<SkyDirectionTable> ParseSkyDirections(std::string_view text, const std::string& name);

/// Reads a CSV file with the columns azimuth_deg and elevation_deg ("-" is standard input). Appends
/// luminance_cd_m2,x,y,r,g,b to each row and keeps other columns. Values are those of the sky
/// without the sun's disc; below the horizon, of the ground with `ground_albedo`. With `json`,
/// writes one object per line. `output` empty: standard output. Errors: those of the file, with the
/// line, before anything is written; as WriteError.
Result<void> WriteSkyDirections(const sky::SkyModel& sky, double ground_albedo,
                                const std::string& csv, const std::string& output, bool json);

}  // namespace pleinair::app
