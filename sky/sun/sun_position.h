#pragma once

#include "base/frames.h"
#include "base/units.h"
#include "base/utc_time.h"

namespace pleinair::sky {

/// Where the observer stands and the air he looks through.
struct Observer {
  Radians latitude;    ///< North positive, geodetic (WGS 84).
  Radians longitude;   ///< East positive.
  Metres height{0.0};  ///< Above the ellipsoid.
  double pressure_mbar = 1010.0;
  double temperature_c = 10.0;
  /// UT1 − UTC, which IERS publishes; within ±0.9 s. Leaving it out turns the sky by at most
  /// 0.0038°.
  double ut1_minus_utc_s = 0.0;
};

struct SunPosition {
  Radians azimuth;    ///< Clockwise from true north, 0…2π.
  Radians elevation;  ///< Topocentric, airless.
  /// As seen through the air (sky/sun/refraction.h); equals `elevation` far below the horizon.
  Radians elevation_refracted;
  double distance_au = 1.0;  ///< Observer to sun, astronomical units.

  /// Unit vector to the refracted sun: east, north, up.
  Direction<World> ToSun() const;

  /// Half the angle under which the disc is seen: 959.63″ at 1 au.
  Radians AngularRadius() const;
};

enum class SunModel {
  kPrecise,  ///< ERFA (IAU 2006/2000); 0.001° from 1950 to 2100.
  kPaper,    ///< Kolivand & Sunar 2014, Eqs. 1–4 with their five corrections; 1.4° at most.
};

/// The sun's place in the sky. Safe to call from several threads at once.
///
/// A library built without ERFA (PLEINAIR_GRAPHICS_ONLY on a machine that lacks it) answers
/// kPrecise with kPaper; HasPreciseSun() tells.
SunPosition ComputeSunPosition(const Observer& observer, UtcTime time,
                               SunModel model = SunModel::kPrecise);

/// Whether kPrecise is what it says.
bool HasPreciseSun();

}  // namespace pleinair::sky
