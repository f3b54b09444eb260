#include "sky/sun/sun_events.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "sky/sun/sun_clock.h"

namespace pleinair::sky {
namespace {

constexpr double kDaySeconds = 86'400.0;

/// The zero of (hour angle − `target`) nearest to `guess`. The hour angle grows by 15° per hour to
/// within some seconds a day, so Newton's steps with that constant slope converge fast.
UtcTime FindTransit(const Observer& observer, UtcTime guess, double target_rad, SunModel model) {
  constexpr double kSecondsPerRadian = 0.5 * kDaySeconds / std::numbers::pi;
  constexpr double kToleranceSeconds = 0.001;
  constexpr int kMaxSteps = 12;  // Each gains three digits; discontinuities of `paper` cost some.
  UtcTime time = guess;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double off_rad = std::remainder(HourAngle(observer, time, model).value() - target_rad,
                                          2.0 * std::numbers::pi);
    time = time.PlusSeconds(-off_rad * kSecondsPerRadian);
    if (std::fabs(off_rad) * kSecondsPerRadian < kToleranceSeconds) break;
  }
  return time;
}

}  // namespace

SunEvents ComputeSunEventsNear(const Observer& observer, UtcTime middle, SunModel model) {
  SunEvents events;
  events.noon = FindTransit(observer, middle, 0.0, model);
  const UtcTime begin =
      FindTransit(observer, events.noon.PlusSeconds(-0.5 * kDaySeconds), std::numbers::pi, model);
  const UtcTime end =
      FindTransit(observer, events.noon.PlusSeconds(0.5 * kDaySeconds), std::numbers::pi, model);
  const SunDay day = ComputeSunDay(observer, begin, end, model);
  for (std::size_t h = 0; h < kSunHorizons; ++h) {
    const HorizonPassages& passages = day.passages[h];
    if (passages.Always()) events.presences[h] = SunPresence::kStaysUp;
    if (passages.Never()) events.presences[h] = SunPresence::kStaysDown;
    for (const UtcTime rise : passages.rises) {
      if (rise <= events.noon || !events.dawns[h]) events.dawns[h] = rise;
    }
    for (const UtcTime set : passages.sets) {
      if (!events.dusks[h] || *events.dusks[h] < events.noon) events.dusks[h] = set;
    }
  }
  events.sunrise = events.Dawn(SunHorizon::kSunrise);
  events.sunset = events.Dusk(SunHorizon::kSunrise);
  return events;
}

UtcTime MiddleOfDay(UtcTime time, double offset_s) {
  const double local_s = static_cast<double>(time.nanoseconds_since_1970()) * 1e-9 + offset_s;
  const double into_day_s = local_s - std::floor(local_s / kDaySeconds) * kDaySeconds;
  return time.PlusSeconds(0.5 * kDaySeconds - into_day_s);
}

SunEvents ComputeSunEvents(const Observer& observer, UtcTime time, SunModel model) {
  constexpr double kSecondsPerDegree = 240.0;
  const double mean_solar_offset_s = ToDegrees(observer.longitude) * kSecondsPerDegree;
  return ComputeSunEventsNear(observer, MiddleOfDay(time, mean_solar_offset_s), model);
}

}  // namespace pleinair::sky
