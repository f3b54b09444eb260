#include "sky/sun_events.h"

#include <cmath>
#include <functional>

namespace pleinair::sky {
namespace {

constexpr double kRiseElevationDeg = -0.8333;  // 34′ of refraction and 16′ of disc.
constexpr double kStepSeconds = 600.0;
constexpr double kToleranceSeconds = 0.05;

using Function = std::function<double(double)>;

/// Where `f` passes zero between `low` and `high`, seconds; one of them has the other sign.
double Bisect(const Function& f, double low, double high) {
  const bool low_is_positive = f(low) > 0.0;
  while (std::fabs(high - low) > kToleranceSeconds) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == low_is_positive ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

SunEvents ComputeSunEvents(const Observer& observer, UtcTime time, SunModel model) {
  // Local mean noon of the day of `time`, and how far true noon is from it: within 17 minutes.
  constexpr double kDaySeconds = 86'400.0;
  const double seconds = static_cast<double>(time.nanoseconds_since_1970()) * 1e-9;
  const double local_offset = ToDegrees(observer.longitude) * 240.0;
  const double midnight =
      std::floor((seconds + local_offset) / kDaySeconds) * kDaySeconds - local_offset;
  const auto at = [](double s) {
    return UtcTime(static_cast<std::int64_t>(std::llround(s * 1e3)) * 1'000'000);
  };
  const auto sun_at = [&](double s) { return ComputeSunPosition(observer, at(s), model); };

  const auto east = [&](double s) {
    const SunPosition sun = sun_at(s);
    return std::cos(sun.elevation.value()) * std::sin(sun.azimuth.value());
  };
  const double mean_noon = midnight + 0.5 * kDaySeconds;
  const double noon = Bisect(east, mean_noon - 3600.0, mean_noon + 3600.0);

  const auto above = [&](double s) { return ToDegrees(sun_at(s).elevation) - kRiseElevationDeg; };
  SunEvents events;
  events.noon = at(noon);
  if (above(noon) <= 0.0) return events;
  const auto crossing = [&](double step) -> std::optional<UtcTime> {
    for (double s = noon; std::fabs(s - noon) < 0.5 * kDaySeconds; s += step) {
      if (above(s + step) <= 0.0) return at(Bisect(above, s, s + step));
    }
    return std::nullopt;
  };
  events.sunrise = crossing(-kStepSeconds);
  events.sunset = crossing(kStepSeconds);
  return events;
}

}  // namespace pleinair::sky
