#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/vector.h"
#include "compositor/photometry/changes/light_changes.h"
#include "session/light_summary.h"

namespace pleinair::app {

/// Light of one frame. `sun` and `sky` are the display-linear values that a white, level,
/// Lambertian surface in the open has from each.
struct LightRow {
  std::int64_t frame_index = 0;
  std::int64_t timestamp_ns = 0;  ///< Since the recording's start.
  LinearRgb sun, sky;
  double sun_to_sky_error = 0.0;  ///< Relative, one standard deviation.
  compositor::FrameLight::Source source = compositor::FrameLight::Source::kHeld;
};

/// The row of a composed frame. `timestamp_ns`: since the recording's start.
LightRow LightRowOf(std::int64_t frame_index, std::int64_t timestamp_ns,
                    const session::LightSummary& light);

/// Names of the sources in files: "surfaces", "print", "total only", "layers", "held".
const char* LightSourceName(compositor::FrameLight::Source source);

/// Adds rows for the frames between those of `rows` that have none: their light is interpolated
/// geometrically, or that of the nearest row. `frames`: index and time stamp of all frames, in
/// order, as are `rows`.
std::vector<LightRow> WithMissingFrames(
    const std::vector<LightRow>& rows,
    const std::vector<std::pair<std::int64_t, std::int64_t>>& frames);

/// The rows as CSV with a header:
/// frame,timestamp_s,sun_r,sun_g,sun_b,sky_r,sky_g,sky_b,sun_to_sky,sun_to_sky_error,source
std::string LightCsv(const std::vector<LightRow>& rows);

}  // namespace pleinair::app
