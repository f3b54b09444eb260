#include <chrono>
#include <cmath>
#include <numbers>

#include "sky/sun/sun_models.h"

namespace pleinair::sky::internal {
namespace {

using std::numbers::pi;

/// J of the equations: the day of the year, 1 on the first of January. The paper calls it "Julian
/// date", but a period of 368 days fits the day of the year only.
int DayOfYear(UtcTime time) {
  using std::chrono::days;
  using std::chrono::nanoseconds;
  const std::chrono::sys_days today(
      std::chrono::floor<days>(nanoseconds(time.nanoseconds_since_1970())));
  const std::chrono::year year = std::chrono::year_month_day(today).year();
  const std::chrono::sys_days new_year(year / std::chrono::January / 1);
  return static_cast<int>((today - new_year).count()) + 1;
}

}  // namespace

// Kolivand & Sunar 2014, Eqs. (1)–(4), which restate Preetham et al. 1999, appendix. Five misprints
// are corrected (tests/sky/sun/sun_position_paper_test.cc shows the effect of each):
//   Eq. (1): J − 180 → J − 80.
//   Eq. (1): (12/π)(SM − L)/π → (12/π)(L − SM): one π too many, and their sign is for longitudes
//            counted westwards, ours grow eastwards.
//   Eq. (2): J − 8 → J − 81.
//   Eq. (4): the denominator's minus → plus, and the quadrant needs atan2.
//   "Julian date" → day of the year.
AirlessSun PaperSun(const Observer& observer, UtcTime time) {
  const UtcTime::Civil utc = time.ToCivil();
  const double j = DayOfYear(time);
  const double standard_time_h = utc.hour + utc.minute / 60.0 + utc.second / 3600.0;
  const double standard_meridian_rad = 0.0;  // Of UTC.

  // Eq. (1): solar time in hours.
  const double t = standard_time_h + 0.170 * std::sin(4.0 * pi * (j - 80.0) / 373.0) -
                   0.129 * std::sin(2.0 * pi * (j - 8.0) / 355.0) +
                   12.0 / pi * (observer.longitude.value() - standard_meridian_rad);
  // Eq. (2): declination.
  const double declination = 0.4093 * std::sin(2.0 * pi * (j - 81.0) / 368.0);

  const double hour_rad = pi * t / 12.0;  // From midnight.
  const double sin_l = std::sin(observer.latitude.value());
  const double cos_l = std::cos(observer.latitude.value());
  const double sin_d = std::sin(declination);
  const double cos_d = std::cos(declination);
  // Eq. (3), as elevation. Rounding may move its argument out of [−1, 1].
  const double up = sin_l * sin_d - cos_l * cos_d * std::cos(hour_rad);
  // Eq. (4): the components towards east and north.
  const double east = cos_d * std::sin(hour_rad);
  const double north = cos_l * sin_d + sin_l * cos_d * std::cos(hour_rad);
  const double azimuth = std::atan2(east, north);

  // The paper gives no distance; this is IES RP-21's annual variation of sunlight, 1/d².
  const double distance_au = 1.0 / std::sqrt(1.0 + 0.034 * std::cos(2.0 * pi * (j - 2.0) / 365.0));
  return {azimuth < 0.0 ? azimuth + 2.0 * pi : azimuth, std::atan2(up, std::hypot(east, north)),
          distance_au};
}

}  // namespace pleinair::sky::internal
