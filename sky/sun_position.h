#pragma once

#include "base/frames.h"
#include "base/units.h"
#include "base/utc_time.h"

namespace pleinair::sky {

/// Where the observer stands and the air he looks through.
struct Observer {
  Radians latitude;             ///< North positive, geodetic.
  Radians longitude;            ///< East positive.
  Metres height{0.0};           ///< Above sea level.
  double pressure_mbar = 1010.0;
  double temperature_c = 10.0;
};

struct SunPosition {
  Radians azimuth;              ///< Clockwise from true north, 0…2π.
  Radians elevation;            ///< Topocentric, airless.
  Radians elevation_refracted;  ///< As seen through the air; equals `elevation` far below the horizon.
  double distance_au = 1.0;     ///< Observer to sun, astronomical units.

  /// Unit vector to the refracted sun: east, north, up.
  Direction<World> ToSun() const;
};

enum class SunModel {
  kPrecise,  ///< ERFA (IAU 2006/2000A); 0.001° from 1950 to 2100.
  kPaper,    ///< Kolivand & Sunar 2014, Eqs. 1–4 with their five corrections; 1.4° at most.
};

/// The sun's place in the sky.
SunPosition ComputeSunPosition(const Observer& observer, UtcTime time,
                               SunModel model = SunModel::kPrecise);

}  // namespace pleinair::sky
