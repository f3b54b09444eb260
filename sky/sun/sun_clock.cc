#include "sky/sun/sun_clock.h"

#include <cmath>
#include <numbers>

namespace pleinair::sky {

using std::numbers::pi;

Radians HourAngle(const Observer& observer, UtcTime time, SunModel model) {
  const SunPosition sun = ComputeSunPosition(observer, time, model);
  const double horizontal = std::cos(sun.elevation.value());
  const double east = horizontal * std::sin(sun.azimuth.value());
  const double north = horizontal * std::cos(sun.azimuth.value());
  const double up = std::sin(sun.elevation.value());
  // Rotated about the east axis into the equator's frame: the component towards the intersection of
  // meridian and equator.
  const double on_meridian =
      up * std::cos(observer.latitude.value()) - north * std::sin(observer.latitude.value());
  return Radians(std::atan2(-east, on_meridian));
}

double EquationOfTimeSeconds(UtcTime time, double ut1_minus_utc_s, SunModel model) {
  // At the pole parallax and diurnal aberration do not change the hour angle: it is the geocentric
  // one, as the almanacs define it.
  const Observer pole{
      .latitude = Radians(0.5 * pi), .longitude = Radians(0.0), .ut1_minus_utc_s = ut1_minus_utc_s};
  std::int64_t in_day = time.nanoseconds_since_1970() % pleinair::internal::kNanosecondsPerDay;
  if (in_day < 0) in_day += pleinair::internal::kNanosecondsPerDay;
  const double ut1_day_s = static_cast<double>(in_day) * 1e-9 + ut1_minus_utc_s;
  constexpr double kSecondsPerRadian = 43'200.0 / pi;
  const double apparent_s = HourAngle(pole, time, model).value() * kSecondsPerRadian + 43'200.0;
  return std::remainder(apparent_s - ut1_day_s, 86'400.0);
}

}  // namespace pleinair::sky
