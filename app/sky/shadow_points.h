#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/sky/layered_sky.h"
#include "base/error.h"
#include "base/vector.h"

namespace pleinair::app {

/// A row of a table of points, with its text for the output.
struct ShadowPointRow {
  Vec3 place_m;           ///< East, north, height above the place.
  double seconds = 0.0;   ///< After the stated time.
  std::string_view text;  ///< Points into the table's text, without its line end.
};

/// A parsed CSV table of points. Its rows point into the text.
struct ShadowPointTable {
  std::string_view header;
  std::vector<ShadowPointRow> rows;
};

/// Parses `east_m,north_m[,height_m][,seconds]`: columns by name in any order; others are ignored.
/// Rows without seconds have `seconds`. `name` is the file's; errors contain it and the line.
/// `text` must outlive the table.
Result<ShadowPointTable> ParseShadowPoints(std::string_view text, const std::string& name,
                                           double seconds);

/// Reads a CSV file of points ("-" is standard input). Appends sun_transmittance,sun_normal_lux to
/// each row. With `json`, writes one object per line. `output` empty: standard output. Errors:
/// those of the file, before anything is written; as WriteError.
Result<void> WriteCloudShadow(const LayeredSky& skies, const SkyMoment& moment,
                              const std::string& csv, const std::string& output, bool json);

}  // namespace pleinair::app
