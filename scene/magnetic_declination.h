#pragma once

#include "base/error.h"
#include "base/units.h"
#include "base/utc_time.h"

namespace pleinair::scene {

/// Angle from true north to magnetic north, clockwise (east) positive, by the World Magnetic Model
/// WMM2025 (NOAA/NCEI and BGS 2024): B = -grad V with
///
///   V = a sum over n = 1…12, m = 0…n of (a/r)^(n+1) (g_nm(t) cos m λ + h_nm(t) sin m λ) P_nm(sin
///   φ')
///
/// (WMM2025 technical report, Eqs. 1 and 2), Schmidt semi-normalised, a = 6371.2 km, coefficients
/// linear in time. GeographicLib sums the series. Declination = atan2(east, north) of B.
///
/// `height_m` above sea level is taken for that above the ellipsoid: a difference of 100 m changes
/// the declination by less than 0.01°. The model knows neither iron nor magnetic rocks nearby; its
/// own error is about 0.3° at middle latitudes, and the real field differs locally by more.
///
/// Errors (input): a time outside of the model's years, 2024-11-13 to 2029-12-31; a place where the
/// horizontal field is below 2000 nT, the report's blackout zones around the magnetic poles.
Result<Radians> MagneticDeclination(double latitude_deg, double longitude_deg, double height_m,
                                    UtcTime time);

}  // namespace pleinair::scene
