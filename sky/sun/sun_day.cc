#include "sky/sun/sun_day.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "sky/sun/sun_clock.h"

namespace pleinair::sky {
namespace {

constexpr double kStepSeconds = 900.0;
constexpr double kTransitStepSeconds = 10'800.0;  // The hour angle grows uniformly.
constexpr double kRootToleranceSeconds = 0.05;
// This close to an extremum the elevation is within 4e-8° of it: its second derivative is at most
// the square of the Earth's rotation rate, 3e-7° / s².
constexpr double kExtremumToleranceSeconds = 0.5;

struct Sample {
  double seconds = 0.0;  ///< After the start of the span.
  double value = 0.0;
};

/// Bisects for the time at which `is_high` changes between `low` and `high`.
template <typename IsHigh>
double Bisect(const IsHigh& is_high, double low, double high) {
  const bool at_low = is_high(low);
  while (high - low > kRootToleranceSeconds) {
    const double middle = 0.5 * (low + high);
    (is_high(middle) == at_low ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Maximum of `sign` · f between two times, by golden-section search (Kiefer 1953).
template <typename Function>
Sample FindExtremum(const Function& f, double sign, double low, double high) {
  constexpr double kGolden = std::numbers::phi - 1.0;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = sign * f(left), at_right = sign * f(right);
  while (high - low > kExtremumToleranceSeconds) {
    if (at_left < at_right) {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = sign * f(right);
    } else {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = sign * f(left);
    }
  }
  return at_left < at_right ? Sample{right, sign * at_right} : Sample{left, sign * at_left};
}

/// Samples at regular steps over the span and one step beyond each end, plus the extrema between
/// them.
template <typename Function>
std::vector<Sample> SampleWithExtrema(const Function& f, double span_s) {
  std::vector<Sample> regular;
  const auto steps = static_cast<std::int64_t>(std::ceil(span_s / kStepSeconds));
  for (std::int64_t i = -1; i <= steps + 1; ++i) {
    const double s = static_cast<double>(i) * kStepSeconds;
    regular.push_back({s, f(s)});
  }
  std::vector<Sample> samples{regular.front()};
  for (std::size_t i = 1; i + 1 < regular.size(); ++i) {
    const Sample &before = regular[i - 1], &here = regular[i], &after = regular[i + 1];
    const bool highest = here.value >= before.value && here.value > after.value;
    const bool lowest = here.value <= before.value && here.value < after.value;
    if (!highest && !lowest) {
      samples.push_back(here);
      continue;
    }
    const Sample extremum = FindExtremum(f, highest ? 1.0 : -1.0, before.seconds, after.seconds);
    if (extremum.seconds < here.seconds) samples.push_back(extremum);
    samples.push_back(here);
    if (extremum.seconds > here.seconds) samples.push_back(extremum);
  }
  samples.push_back(regular.back());
  return samples;
}

}  // namespace

Radians HorizonElevation(SunHorizon horizon) {
  constexpr std::array<double, kSunHorizons> kDegrees = {-0.8333, -6.0, -12.0, -18.0};
  return FromDegrees(kDegrees[static_cast<std::size_t>(horizon)]);
}

SunDay ComputeSunDay(const Observer& observer, UtcTime begin, UtcTime end, SunModel model) {
  SunDay day;
  day.begin = begin;
  day.end = end;
  const double span_s =
      static_cast<double>(end.nanoseconds_since_1970() - begin.nanoseconds_since_1970()) * 1e-9;
  const auto elevation = [&](double s) {
    return ComputeSunPosition(observer, begin.PlusSeconds(s), model).elevation.value();
  };
  const auto hour_angle = [&](double s) {
    return HourAngle(observer, begin.PlusSeconds(s), model).value();
  };
  const std::vector<Sample> samples = SampleWithExtrema(elevation, span_s);
  for (std::size_t h = 0; h < kSunHorizons; ++h) {
    const double threshold = HorizonElevation(static_cast<SunHorizon>(h)).value();
    const auto is_up = [&](double s) { return elevation(s) > threshold; };
    HorizonPassages& passages = day.passages[h];
    bool up_now = is_up(0.0);
    double up_since_s = 0.0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const bool rises = samples[i].value > threshold;
      if (rises == (samples[i - 1].value > threshold)) continue;
      const double at = Bisect(is_up, samples[i - 1].seconds, samples[i].seconds);
      if (at < 0.0 || at >= span_s) continue;
      (rises ? passages.rises : passages.sets).push_back(begin.PlusSeconds(at));
      if (rises) up_since_s = at;
      if (!rises) passages.seconds_above += at - up_since_s;
      up_now = rises;
    }
    if (up_now) passages.seconds_above += span_s - up_since_s;
  }
  double before = hour_angle(0.0);
  for (double s = 0.0; s < span_s; s += kTransitStepSeconds) {
    const double after = hour_angle(s + kTransitStepSeconds);
    const bool upper = before < 0.0 && after >= 0.0;
    if (upper || (before > 0.0 && after <= 0.0)) {
      const double at = Bisect([&](double t) { return (hour_angle(t) >= 0.0) == upper; }, s,
                               s + kTransitStepSeconds);
      if (at >= 0.0 && at < span_s) {
        (upper ? day.noons : day.midnights).push_back(begin.PlusSeconds(at));
      }
    }
    before = after;
  }
  return day;
}

}  // namespace pleinair::sky
