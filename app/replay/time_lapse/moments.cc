#include "app/replay/time_lapse/moments.h"

#include <charconv>
#include <chrono>
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

constexpr int kMaxDays = 366;  // Longest step: a year.

constexpr const char* kHoursRemedy =
    "write 05:00..21:00, 05:00..21:00+02:00, day, or 2025-04-15..2025-10-15@12:00";
constexpr const char* kEveryRemedy = "write 10min, 90s or 1h";
constexpr const char* kEveryDaysRemedy = "write 1d, 7d or 2w";

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

/// Returns "2025-04-15" as days since 1970.
std::optional<std::int64_t> ParseDate(std::string_view text) {
  constexpr std::size_t kLength = 10;
  if (text.size() != kLength || text[4] != '-' || text[7] != '-') return std::nullopt;
  int year = 0;
  unsigned month = 0, day = 0;
  const char* begin = text.data();
  const auto y = std::from_chars(begin, begin + 4, year);
  const auto m = std::from_chars(begin + 5, begin + 7, month);
  const auto d = std::from_chars(begin + 8, begin + kLength, day);
  if (y.ptr != begin + 4 || m.ptr != begin + 7 || d.ptr != begin + kLength) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month),
                                         std::chrono::day(day)};
  constexpr int kFirstYear = 1900, kLastYear = 2100;
  if (!date.ok() || year < kFirstYear || year > kLastYear) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

/// Nothing: the text is none of dates.
Result<std::optional<TimeLapseOptions::Dates>> ParseDates(std::string_view text) {
  constexpr std::size_t kDate = 10, kSpan = 2 * kDate + 2, kClock = 5;
  const auto fail = [&](const char* what) {
    return InputError("--time-lapse", "\"" + std::string(text.substr(0, 48)) + "\" " + what,
                      kHoursRemedy);
  };
  if (text.size() < kSpan || text.substr(kDate, 2) != "..") return std::nullopt;
  const auto from = ParseDate(text.substr(0, kDate));
  const auto until = ParseDate(text.substr(kDate + 2, kDate));
  if (!from || !until) return fail("has a date that does not exist");
  if (*until < *from) return fail("ends before it begins");
  TimeLapseOptions::Dates dates{*from, *until, std::nullopt, std::nullopt};
  std::string_view rest = text.substr(kSpan);
  if (rest.empty()) return dates;
  dates.at_min = rest[0] == '@' ? ParseClock(rest.substr(1, kClock)) : std::nullopt;
  if (!dates.at_min || *dates.at_min == kMinutesOfDay) {
    return fail("does not end with a time of day");
  }
  rest = rest.substr(1 + kClock);
  if (rest.empty()) return dates;
  PLEINAIR_ASSIGN_OR_RETURN(dates.clock, ParseUtcOffset(rest, "--time-lapse"));
  return dates;
}

Result<double> ParseEvery(const std::string& every, bool days) {
  constexpr double kDay_s = 86'400.0;
  double number = 0.0;
  const auto parsed = std::from_chars(every.data(), every.data() + every.size(), number);
  const std::string_view unit(parsed.ptr, every.data() + every.size());
  double seconds = 0.0;
  if (days) {
    seconds = unit == "d" ? kDay_s : unit == "w" ? 7.0 * kDay_s : 0.0;
  } else {
    seconds = unit == "s" ? 1.0 : unit == "min" ? 60.0 : unit == "h" ? 3600.0 : 0.0;
  }
  const double every_s = number * seconds;
  const bool fits =
      days ? every_s >= kDay_s && every_s <= kMaxDays * kDay_s && std::fmod(every_s, kDay_s) == 0.0
           : every_s >= kMinPeriod_s && every_s <= kDay_s;
  if (parsed.ec == std::errc() && fits) return every_s;
  return InputError("--every",
                    "\"" + every.substr(0, 40) + "\" is not a step of " + (days ? "days" : "time"),
                    days ? kEveryDaysRemedy : kEveryRemedy);
}

Result<void> CheckCount(std::size_t pictures) {
  if (pictures <= kMaxPictures) return {};
  return InputError("--every", "gives " + std::to_string(pictures) + " pictures",
                    "take longer steps: " + std::to_string(kMaxPictures) + " are the most");
}

/// Midnight before the recording begins, and its minute of the day, on a clock.
struct StartOnClock {
  UtcTime midnight;
  int minute = 0;
};

StartOnClock StartOn(UtcOffset clock, const scene::PlaceTime& place) {
  constexpr std::int64_t kDayNs = internal::kNanosecondsPerDay;
  const std::int64_t on_clock_ns =
      place.start.PlusSeconds(clock.seconds()).nanoseconds_since_1970();
  const std::int64_t into_day_ns = (on_clock_ns % kDayNs + kDayNs) % kDayNs;
  return {UtcTime(place.start.nanoseconds_since_1970() - into_day_ns),
          static_cast<int>(into_day_ns / (60 * internal::kNanosecondsPerSecond))};
}

Result<TimeLapseMoments> MomentsOfDates(const TimeLapseOptions::Dates& dates, double every_s,
                                        const scene::PlaceTime& place) {
  TimeLapseMoments moments;
  moments.over_dates = true;
  moments.clock = dates.clock.value_or(NauticalOffset(place.longitude_deg));
  const int minute = dates.at_min.value_or(StartOn(moments.clock, place).minute);
  const auto step = static_cast<std::int64_t>(every_s / 86'400.0);
  const auto steps = static_cast<std::size_t>((dates.until_day - dates.from_day) / step);
  PLEINAIR_RETURN_IF_ERROR(CheckCount(steps + 1));
  for (std::size_t i = 0; i <= steps; ++i) {
    const UtcTime midnight((dates.from_day + static_cast<std::int64_t>(i) * step) *
                           internal::kNanosecondsPerDay);
    moments.times.push_back(midnight.PlusSeconds(60.0 * minute - moments.clock.seconds()));
  }
  return moments;
}

}  // namespace

Result<TimeLapseOptions> ParseTimeLapse(const std::string& hours,
                                        const std::optional<std::string>& every) {
  TimeLapseOptions options;
  PLEINAIR_ASSIGN_OR_RETURN(options.dates, ParseDates(hours));
  if (!options.dates && hours != "day") {
    PLEINAIR_ASSIGN_OR_RETURN(options.hours, ParseHours(hours));
  }
  const bool days = options.dates.has_value();
  PLEINAIR_ASSIGN_OR_RETURN(options.every_s,
                            ParseEvery(every.value_or(days ? "1d" : "10min"), days));
  return options;
}

Result<TimeLapseMoments> MomentsOf(const TimeLapseOptions& options, const scene::PlaceTime& place) {
  if (options.dates) return MomentsOfDates(*options.dates, options.every_s, place);
  TimeLapseMoments moments;
  moments.clock = NauticalOffset(place.longitude_deg);
  if (options.hours && options.hours->clock) moments.clock = *options.hours->clock;
  const UtcTime midnight = StartOn(moments.clock, place).midnight;
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
  PLEINAIR_RETURN_IF_ERROR(CheckCount(steps + 1));
  for (std::size_t i = 0; i <= steps; ++i) {
    moments.times.push_back(from.PlusSeconds(static_cast<double>(i) * options.every_s));
  }
  return moments;
}

}  // namespace pleinair::app
