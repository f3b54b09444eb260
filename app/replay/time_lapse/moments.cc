#include "app/replay/time_lapse/moments.h"

#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "sky/sun/sun_day.h"

namespace pleinair::app {
namespace {

constexpr int kMinutesOfDay = 1440;
constexpr std::size_t kMaxPictures = 1440;
// Twilight before sunrise and after sunset.
constexpr double kTwilight_s = 1800.0;
constexpr double kMinPeriod_s = 1.0;

constexpr const char* kHoursRemedy = "write 05:00..21:00, 05:00..21:00+02:00 or day";
constexpr const char* kEveryRemedy = "write 10min, 90s or 1h";

/// Returns "05:00" as minutes after midnight.
std::optional<int> ParseClock(std::string_view text) {
  if (text.size() != 5 || text[2] != ':') return std::nullopt;
  int hours = 0, minutes = 0;
  const char* begin = text.data();
  const auto h = std::from_chars(begin, begin + 2, hours);
  const auto m = std::from_chars(begin + 3, begin + 5, minutes);
  if (h.ptr != begin + 2 || m.ptr != begin + 5 || hours < 0 || minutes < 0 || minutes > 59) {
    return std::nullopt;
  }
  const int sum = 60 * hours + minutes;
  return sum <= kMinutesOfDay ? std::optional(sum) : std::nullopt;
}

Result<TimeLapseOptions::Hours> ParseHours(std::string_view text) {
  const auto fail = [&](const char* what) {
    return InputError("--time-lapse", "\"" + std::string(text.substr(0, 40)) + "\" " + what,
                      kHoursRemedy);
  };
  constexpr std::size_t kClock = 5;
  const std::size_t dots = text.find("..");
  if (dots != kClock || text.size() < 2 * kClock + 2) return fail("is not a part of a day");
  const auto from = ParseClock(text.substr(0, kClock));
  const auto until = ParseClock(text.substr(kClock + 2, kClock));
  if (!from || !until) return fail("is not a part of a day");
  if (*until < *from) return fail("ends before it begins");
  TimeLapseOptions::Hours hours{*from, *until, std::nullopt};
  const std::string_view offset = text.substr(2 * kClock + 2);
  if (offset.empty()) return hours;
  PLEINAIR_ASSIGN_OR_RETURN(hours.clock, ParseUtcOffset(offset, "--time-lapse"));
  return hours;
}

}  // namespace

Result<TimeLapseOptions> ParseTimeLapse(const std::string& hours, const std::string& every) {
  TimeLapseOptions options;
  if (hours != "day") {
    PLEINAIR_ASSIGN_OR_RETURN(options.hours, ParseHours(hours));
  }
  double number = 0.0;
  const auto parsed = std::from_chars(every.data(), every.data() + every.size(), number);
  const std::string_view unit(parsed.ptr, every.data() + every.size());
  const double seconds = unit == "s" ? 1.0 : unit == "min" ? 60.0 : unit == "h" ? 3600.0 : 0.0;
  options.every_s = number * seconds;
  if (parsed.ec != std::errc() || !(options.every_s >= kMinPeriod_s && options.every_s <= 86'400)) {
    return InputError("--every", "\"" + every.substr(0, 40) + "\" is not a step of time",
                      kEveryRemedy);
  }
  return options;
}

Result<TimeLapseMoments> MomentsOf(const TimeLapseOptions& options, const scene::PlaceTime& place) {
  TimeLapseMoments moments;
  moments.clock = NauticalOffset(place.longitude_deg);
  if (options.hours && options.hours->clock) moments.clock = *options.hours->clock;
  constexpr std::int64_t kDayNs = internal::kNanosecondsPerDay;
  const std::int64_t on_clock_ns =
      place.start.PlusSeconds(moments.clock.seconds()).nanoseconds_since_1970();
  const std::int64_t into_day_ns = (on_clock_ns % kDayNs + kDayNs) % kDayNs;
  const UtcTime midnight(place.start.nanoseconds_since_1970() - into_day_ns);
  UtcTime from, until;
  if (options.hours) {
    from = midnight.PlusSeconds(60.0 * options.hours->from_min);
    until = midnight.PlusSeconds(60.0 * options.hours->until_min);
  } else {
    const sky::Observer observer{FromDegrees(place.latitude_deg), FromDegrees(place.longitude_deg),
                                 Metres(place.height_m)};
    const sky::SunDay day =
        sky::ComputeSunDay(observer, midnight, midnight.PlusSeconds(60.0 * kMinutesOfDay));
    const sky::HorizonPassages& sun = day.At(sky::SunHorizon::kSunrise);
    if (sun.rises.empty() || sun.sets.empty() || sun.sets.back() < sun.rises.front()) {
      return InputError("--time-lapse", "the sun does not rise and set on that day there",
                        "give the hours, for example 00:00..24:00");
    }
    from = sun.rises.front().PlusSeconds(-kTwilight_s);
    until = sun.sets.back().PlusSeconds(kTwilight_s);
  }
  const double span_s =
      static_cast<double>(until.nanoseconds_since_1970() - from.nanoseconds_since_1970()) * 1e-9;
  const auto steps = static_cast<std::size_t>(span_s / options.every_s + 1e-6);
  if (steps >= kMaxPictures) {
    return InputError("--every", "gives " + std::to_string(steps + 1) + " pictures",
                      "take longer steps: " + std::to_string(kMaxPictures) + " are the most");
  }
  for (std::size_t i = 0; i <= steps; ++i) {
    moments.times.push_back(from.PlusSeconds(static_cast<double>(i) * options.every_s));
  }
  return moments;
}

}  // namespace pleinair::app
