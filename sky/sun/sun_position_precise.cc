#include <erfa.h>
#include <erfam.h>

#include <cmath>
#include <cstdint>
#include <mutex>
#include <numbers>

#include "sky/sun/delta_t.h"
#include "sky/sun/sun_models.h"

namespace pleinair::sky {

bool HasPreciseSun() { return true; }

namespace internal {
namespace {

constexpr double kSecondsPerDay = 86'400.0;

/// TAI − UTC of the leap-second table; UTC must not be before 1972.
double LeapSeconds(const UtcTime::Civil& utc, double day_fraction) {
  // ERFA fills its table at the first call, without a lock.
  static std::once_flag table_ready;
  std::call_once(table_ready, [] {
    double ignored = 0.0;
    eraDat(2000, 1, 1, 0.0, &ignored);
  });
  double tai_minus_utc = 0.0;
  // Status +1 only warns that the date lies long after the library's release.
  eraDat(utc.year, utc.month, utc.day, day_fraction, &tai_minus_utc);
  return tai_minus_utc;
}

/// TT − UTC in seconds. Before 1972 (no leap seconds) and in the far future (leap seconds unknown)
/// UTC is taken as UT1, and the difference is that of Espenak & Meeus. From 2025 to 2050 the two
/// are blended. One second moves the sun by 0.041″.
double TerrestrialMinusUtc(const UtcTime::Civil& utc, double day_fraction) {
  constexpr double kLeapSecondsBegin = 1972.0;
  constexpr double kTableEnds = 2025.0;
  constexpr double kForecastOnly = 2050.0;
  const double year = utc.year + (utc.month - 1 + (utc.day - 0.5) / 31.0) / 12.0;
  if (year < kLeapSecondsBegin || year >= kForecastOnly) return DeltaTSeconds(year);
  const double from_table = LeapSeconds(utc, day_fraction) + 32.184;  // TT − TAI, by definition.
  if (year < kTableEnds) return from_table;
  const double forecast_share = (year - kTableEnds) / (kForecastOnly - kTableEnds);
  return from_table + forecast_share * (DeltaTSeconds(year) - from_table);
}

/// Bias, precession and nutation: celestial to true equator and equinox of date. IAU 2006
/// precession with the nutation of IAU 2000B.
// Deviation: eraPnm06a takes IAU 2000A with its 1,365 terms; 2000B (77 terms) differs by 1 mas =
// 3e-7° and the whole position takes a third of the time (tests/sky/sky_benchmark.cc).
void BiasPrecessionNutation(double tt1, double tt2, double matrix[3][3]) {
  double gamma, phi, psi, epsilon, d_psi, d_epsilon;
  eraPfw06(tt1, tt2, &gamma, &phi, &psi, &epsilon);
  eraNut00b(tt1, tt2, &d_psi, &d_epsilon);
  eraFw2m(gamma, phi, psi + d_psi, epsilon + d_epsilon, matrix);
}

}  // namespace

AirlessSun PreciseSun(const Observer& observer, UtcTime time) {
  // Julian date of 1970-01-01, then whole days, separate from the fraction, so that no digit is
  // lost.
  constexpr std::int64_t kDay = pleinair::internal::kNanosecondsPerDay;
  const std::int64_t ns = time.nanoseconds_since_1970();
  const std::int64_t days = ns / kDay - (ns % kDay < 0 ? 1 : 0);
  const double day_fraction = static_cast<double>(ns - days * kDay) / static_cast<double>(kDay);
  const double date1 = 2440587.5 + static_cast<double>(days);
  const double tt2 =
      day_fraction + TerrestrialMinusUtc(time.ToCivil(), day_fraction) / kSecondsPerDay;
  const double ut12 = day_fraction + observer.ut1_minus_utc_s / kSecondsPerDay;

  // Earth around the sun and around the barycentre, au and au/day. The status warns outside
  // 1900–2100, where the series lose a few milliarcseconds only.
  double earth_heliocentric[2][3], earth_barycentric[2][3];
  eraEpv00(date1, tt2, earth_heliocentric, earth_barycentric);

  double celestial_to_true[3][3], pole_x, pole_y;
  BiasPrecessionNutation(date1, tt2, celestial_to_true);
  eraBpn2xy(celestial_to_true, &pole_x, &pole_y);
  const double cio_locator = eraS06(date1, tt2, pole_x, pole_y);
  const double earth_rotation = eraEra00(date1, ut12);
  constexpr double kNoPolarMotion = 0.0;  // ≤ 0.5″.
  constexpr double kNoAir = 0.0;          // Refraction is applied by sky/sun/refraction.h.
  eraASTROM context;
  eraApco(date1, tt2, earth_barycentric, earth_heliocentric[0], pole_x, pole_y, cio_locator,
          earth_rotation, observer.longitude.value(), observer.latitude.value(),
          observer.height.value(), kNoPolarMotion, kNoPolarMotion, eraSp00(date1, tt2), kNoAir,
          kNoAir, &context);

  // The sun at the time when its light left: barycentric = Earth's barycentric − heliocentric.
  double from_observer[3];
  double light_days = 0.0;
  double distance = 1.0;
  for (int iteration = 0; iteration < 2; ++iteration) {
    for (int i = 0; i < 3; ++i) {
      const double sun = earth_barycentric[0][i] - earth_heliocentric[0][i];
      const double velocity = earth_barycentric[1][i] - earth_heliocentric[1][i];
      from_observer[i] = sun - velocity * light_days - context.eb[i];
    }
    distance = eraPm(from_observer);
    light_days = distance * ERFA_AULT / kSecondsPerDay;
  }

  double natural[3], proper[3], intermediate[3];
  eraSxp(1.0 / distance, from_observer, natural);
  eraAb(natural, context.v, distance, context.bm1, proper);  // Aberration.
  eraRxp(context.bpn, proper, intermediate);
  double right_ascension, declination;
  eraC2s(intermediate, &right_ascension, &declination);
  double azimuth, zenith_distance, hour_angle, observed_declination, observed_right_ascension;
  eraAtioq(eraAnp(right_ascension), declination, &context, &azimuth, &zenith_distance, &hour_angle,
           &observed_declination, &observed_right_ascension);
  return {eraAnp(azimuth), 0.5 * std::numbers::pi - zenith_distance, distance};
}

}  // namespace internal
}  // namespace pleinair::sky
