#pragma once

#include <string>

#include "base/error.h"
#include "sky/sky_model.h"

namespace pleinair::app {

/// Reads a CSV file with the columns azimuth_deg and elevation_deg (others are kept; "-" is
/// standard input) and writes each row with luminance_cd_m2,x,y,r,g,b behind it: of the sky without
/// the sun's disc, below the horizon of the ground of `ground_albedo`. An object a line with
/// `json`. `output` empty: standard output. Errors: the file's with the line, nothing is written
/// then; as WriteError.
Result<void> WriteSkyDirections(const sky::SkyModel& sky, double ground_albedo,
                                const std::string& csv, const std::string& output, bool json);

}  // namespace pleinair::app
