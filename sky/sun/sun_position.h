#pragma once

#include "base/frames.h"
#include "base/units.h"
#include "base/utc_time.h"

namespace pleinair::sky {

/// Position of the observer, and the air there.
struct Observer {
  Radians latitude;    ///< North positive, geodetic (WGS 84).
  Radians longitude;   ///< East positive.
  Metres height{0.0};  ///< Above the ellipsoid.
  double pressure_mbar = 1010.0;
  double temperature_c = 10.0;
  /// UT1 − UTC, published by IERS; within ±0.9 s. Leaving it at 0 rotates the sky by at most
  /// 0.0038°.
  double ut1_minus_utc_s = 0.0;
};

struct SunPosition {
  Radians azimuth;    ///< Clockwise from true north, 0…2π.
  Radians elevation;  ///< Topocentric, airless.
  /// Apparent elevation, with refraction (sky/sun/refraction.h); equals `elevation` far below the
  /// horizon.
  Radians elevation_refracted;
  double distance_au = 1.0;  ///< Observer to sun, astronomical units.

  /// Unit vector to the refracted sun: east, north, up.
  Direction<World> ToSun() const;

  /// Half the angle that the disc subtends: 959.63″ at 1 au.
  Radians AngularRadius() const;
};

enum class SunModel {
  kPrecise,  ///< ERFA (IAU 2006/2000); 0.001° from 1950 to 2100.
  kPaper,    ///< Kolivand & Sunar 2014, Eqs. 1–4 with their five corrections; 1.4° at most.
};

/// Position of the sun. Thread-safe.
///
/// In a library built without ERFA (PLEINAIR_GRAPHICS_ONLY on a machine that lacks it), kPrecise
/// uses kPaper; HasPreciseSun() is then false.
SunPosition ComputeSunPosition(const Observer& observer, UtcTime time,
                               SunModel model = SunModel::kPrecise);

/// True if this build computes kPrecise with ERFA.
bool HasPreciseSun();

}  // namespace pleinair::sky
