#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/observer_options.h"
#include "base/error.h"
#include "base/units.h"
#include "base/utc_time.h"
#include "sky/sky_model.h"
#include "sky/sun/sun_position.h"

namespace pleinair::app {

/// The sun's position at a requested time, or a given position.
struct SkyMoment {
  std::optional<UtcTime> time;  ///< Nothing if the sun was given directly.
  Radians sun_azimuth;
  Radians sun_elevation;  ///< Apparent: includes refraction.
  double sun_distance_au = 1.0;

  Direction<World> ToSun() const;
};

/// The sun at a place and time.
SkyMoment MomentAt(const sky::Observer& observer, UtcTime time, sky::SunModel model);

/// Parses "AZIMUTH,ELEVATION" in degrees, with apparent elevation. Errors (input): another value of
/// --sun.
Result<SkyMoment> ParseSunOption(const std::string& text);

/// Returns `from`, and every `step_s` seconds after it up to `until`. Errors (input): the end is
/// before the start, no positive step, more than 100,000 times.
Result<std::vector<UtcTime>> Moments(UtcTime from, UtcTime until, double step_s);

/// The light of the sky at one time.
struct SkyLight {
  SkyMoment moment;
  double sky_horizontal_lx = 0.0;
  double sun_normal_lx = 0.0;
  double sun_horizontal_lx = 0.0;
  double zenith_cd_m2 = 0.0;
  LinearRgb sky_horizontal, sun_normal;

  double GlobalHorizontal() const { return sky_horizontal_lx + sun_horizontal_lx; }
  /// The sky's share of that; 1 in darkness.
  double DiffuseShare() const;
};

SkyLight MeasureSky(const sky::SkyModel& sky, const SkyMoment& moment);

/// Formats as members of a JSON object, a CSV row under kSkyLightColumns, or lines for the user.
std::string SkyLightJson(const SkyLight& light);
std::string SkyLightCsv(const SkyLight& light);
std::string SkyLightText(const SkyLight& light);
inline constexpr const char* kSkyLightColumns =
    "utc,sun_azimuth_deg,sun_elevation_deg,sky_horizontal_lux,sun_normal_lux,sun_horizontal_lux,"
    "global_horizontal_lux,diffuse_share,zenith_luminance_cd_m2";

}  // namespace pleinair::app
