#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.h"

namespace pleinair {

/// A time in UTC: nanoseconds since 1970-01-01T00:00:00Z on the proleptic Gregorian calendar,
/// without leap seconds (as POSIX). Range: years 1678 to 2261.
class UtcTime {
 public:
  struct Civil {
    int year = 1970, month = 1, day = 1, hour = 0, minute = 0;
    double second = 0.0;
  };

  constexpr UtcTime() = default;
  constexpr explicit UtcTime(std::int64_t nanoseconds_since_1970) : ns_(nanoseconds_since_1970) {}

  constexpr std::int64_t nanoseconds_since_1970() const { return ns_; }
  constexpr auto operator<=>(const UtcTime&) const = default;
  constexpr UtcTime PlusSeconds(double seconds) const {
    return UtcTime(ns_ + static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5)));
  }

  Civil ToCivil() const;

  /// RFC 3339 with `Z`; fractional seconds only if they are not zero.
  std::string ToString() const;

  /// Parses RFC 3339 ("2025-09-14T11:05:00Z", "…+02:00", or a space in place of the T). A time
  /// without `Z` or offset is an error, because its zone is ambiguous. A leap second (":60") is
  /// valid only at the end of June or December and becomes the first second of the next day.
  static Result<UtcTime> Parse(std::string_view text);

 private:
  std::int64_t ns_ = 0;
};

namespace internal {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::int64_t kNanosecondsPerDay = 86'400 * kNanosecondsPerSecond;

}  // namespace internal

inline UtcTime::Civil UtcTime::ToCivil() const {
  const std::chrono::sys_time<std::chrono::nanoseconds> time{std::chrono::nanoseconds(ns_)};
  const auto midnight = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(midnight);
  const std::chrono::hh_mm_ss clock(time - midnight);
  Civil civil;
  civil.year = static_cast<int>(date.year());
  civil.month = static_cast<int>(static_cast<unsigned>(date.month()));
  civil.day = static_cast<int>(static_cast<unsigned>(date.day()));
  civil.hour = static_cast<int>(clock.hours().count());
  civil.minute = static_cast<int>(clock.minutes().count());
  civil.second = static_cast<double>(clock.seconds().count()) +
                 static_cast<double>(clock.subseconds().count()) * 1e-9;
  return civil;
}

inline std::string UtcTime::ToString() const {
  const Civil civil = ToCivil();
  std::int64_t fraction = ns_ % internal::kNanosecondsPerSecond;
  if (fraction < 0) fraction += internal::kNanosecondsPerSecond;
  const auto padded = [](std::int64_t value, std::size_t digits) {
    std::string text = std::to_string(value);
    return text.size() < digits ? std::string(digits - text.size(), '0') + text : text;
  };
  std::string text = padded(civil.year, 4) + "-" + padded(civil.month, 2) + "-" +
                     padded(civil.day, 2) + "T" + padded(civil.hour, 2) + ":" +
                     padded(civil.minute, 2) + ":" +
                     padded(static_cast<std::int64_t>(civil.second), 2);
  if (fraction != 0) {
    std::string digits = padded(fraction, 9);
    digits.erase(digits.find_last_not_of('0') + 1);
    text += "." + digits;
  }
  return text + "Z";
}

inline Result<UtcTime> UtcTime::Parse(std::string_view text) {
  const auto fail = [&](std::string what) {
    return InputError("", "time \"" + std::string(text.substr(0, 64)) + "\" " + std::move(what),
                      "write it as RFC 3339 in UTC, for example 2025-09-14T11:05:00Z");
  };
  std::size_t at = 0;
  bool well_formed = true;
  const auto digits = [&](int count) {
    int value = 0;
    for (int i = 0; i < count; ++i, ++at) {
      if (at >= text.size() || text[at] < '0' || text[at] > '9') {
        well_formed = false;
        return 0;
      }
      value = value * 10 + (text[at] - '0');
    }
    return value;
  };
  const auto expect = [&](std::string_view any_of) {
    if (at >= text.size() || any_of.find(text[at]) == std::string_view::npos) {
      well_formed = false;
      return;
    }
    ++at;
  };
  const int year = digits(4);
  expect("-");
  const int month = digits(2);
  expect("-");
  const int day = digits(2);
  expect("Tt ");
  const int hour = digits(2);
  expect(":");
  const int minute = digits(2);
  expect(":");
  const int second = digits(2);
  if (!well_formed) return fail("is not a date and time");
  // Report an impossible date or time before a missing zone.
  if (year < 1678 || year > 2261) return fail("lies outside the years 1678 to 2261");
  const std::chrono::year_month_day date(std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day)));
  if (!date.ok()) return fail("names a day that does not exist");
  if (hour > 23 || minute > 59 || second > 60) return fail("names an hour that does not exist");
  std::int64_t fraction_ns = 0;
  if (at < text.size() && text[at] == '.') {
    std::int64_t place_ns = internal::kNanosecondsPerSecond / 10;
    const std::size_t first = ++at;
    for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at, place_ns /= 10) {
      fraction_ns += (text[at] - '0') * place_ns;
    }
    if (at == first) return fail("has a decimal point without digits");
  }
  if (at == text.size()) return fail("has neither Z nor an offset, so its zone is unknown");
  std::int64_t offset_minutes = 0;
  const char zone = text[at++];
  if (zone == '+' || zone == '-') {
    const int offset_hour = digits(2);
    expect(":");
    const int offset_minute = digits(2);
    if (!well_formed || offset_hour > 23 || offset_minute > 59) return fail("has a bad offset");
    offset_minutes = (zone == '+' ? 1 : -1) * (offset_hour * 60 + offset_minute);
  } else if (zone != 'Z' && zone != 'z') {
    return fail("has neither Z nor an offset, so its zone is unknown");
  }
  if (at != text.size()) return fail("goes on after its offset");
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  const std::int64_t seconds =
      days * 86'400 + hour * 3600 + minute * 60 + second - offset_minutes * 60;
  const UtcTime time(seconds * internal::kNanosecondsPerSecond + fraction_ns);
  if (second == 60) {
    const Civil next = UtcTime(seconds * internal::kNanosecondsPerSecond).ToCivil();
    const bool half_year = (next.month == 1 || next.month == 7) && next.day == 1;
    if (!half_year || next.hour != 0 || next.minute != 0) {
      return fail("names a second 60 that is no leap second");
    }
  }
  return time;
}

}  // namespace pleinair
