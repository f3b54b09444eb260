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

/// Where the sun stands at a moment that was asked for, or where it was put.
struct SkyMoment {
  std::optional<UtcTime> time;  ///< Nothing where the sun was given directly.
  Radians sun_azimuth;
  Radians sun_elevation;  ///< As seen, refraction included.
  double sun_distance_au = 1.0;

  Direction<World> ToSun() const;
};

/// The sun of a place and a time.
SkyMoment MomentAt(const sky::Observer& observer, UtcTime time, sky::SunModel model);

/// "AZIMUTH,ELEVATION" in degrees, the elevation as seen. Errors (input): --sun is something else.
Result<SkyMoment> ParseSunOption(const std::string& text);

/// `from`, and every `step_s` seconds after it up to `until`. Errors (input): the end lies before
/// the begin, no positive step, more than 100,000 moments.
Result<std::vector<UtcTime>> Moments(UtcTime from, UtcTime until, double step_s);

/// What the light of a moment amounts to.
struct SkyLight {
  SkyMoment moment;
  double sky_horizontal_lx = 0.0;
  double sun_normal_lx = 0.0;
  double sun_horizontal_lx = 0.0;
  double zenith_cd_m2 = 0.0;
  LinearRgb sky_horizontal, sun_normal;

  double GlobalHorizontal() const { return sky_horizontal_lx + sun_horizontal_lx; }
  /// The sky's part of that; 1 in the dark.
  double DiffuseShare() const;
};

SkyLight MeasureSky(const sky::SkyModel& sky, const SkyMoment& moment);

/// Members of a JSON object, a row of CSV under kSkyLightColumns, lines for people.
std::string SkyLightJson(const SkyLight& light);
std::string SkyLightCsv(const SkyLight& light);
std::string SkyLightText(const SkyLight& light);
inline constexpr const char* kSkyLightColumns =
    "utc,sun_azimuth_deg,sun_elevation_deg,sky_horizontal_lux,sun_normal_lux,sun_horizontal_lux,"
    "global_horizontal_lux,diffuse_share,zenith_luminance_cd_m2";

}  // namespace pleinair::app
