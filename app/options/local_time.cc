#include "app/options/local_time.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "scene/zoned_time.h"

namespace pleinair::app {
namespace {

constexpr int kMaxHours = 15;

/// Parses a text of one or two digits; nothing otherwise.
std::optional<int> ParseDigits(std::string_view text) {
  if (text.empty() || text.size() > 2 || text.find_first_not_of("0123456789") != text.npos) {
    return std::nullopt;
  }
  int value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::optional<UtcOffset> ParseSigned(std::string_view text) {
  if (text.empty() || (text[0] != '+' && text[0] != '-')) return std::nullopt;
  const std::size_t colon = text.find(':');
  const std::optional<int> hours = ParseDigits(text.substr(1, colon - 1));
  std::optional<int> minutes = 0;
  if (colon != std::string_view::npos) {
    minutes = text.size() == colon + 3 ? ParseDigits(text.substr(colon + 1)) : std::nullopt;
  }
  if (!hours || *hours > kMaxHours || !minutes || *minutes > 59) return std::nullopt;
  return UtcOffset{(text[0] == '-' ? -1 : 1) * (*hours * 60 + *minutes)};
}

Error About(Error error, const std::string& option) {
  error.where = option;
  return error;
}

}  // namespace

Result<UtcOffset> ParseUtcOffset(std::string_view text, const std::string& option) {
  if (text == "Z" || text == "z") return UtcOffset{};
  if (const std::optional<UtcOffset> offset = ParseSigned(text)) return *offset;
  return InputError(option, "\"" + std::string(text.substr(0, 40)) + "\" is not an offset from UTC",
                    "write it as +02:00, -9:30 or Z, at most 15:59 either way");
}

std::string ToString(UtcOffset offset) {
  if (offset.minutes == 0) return "Z";
  const int minutes = std::abs(offset.minutes);
  std::array<char, 16> text;
  std::snprintf(text.data(), text.size(), "%c%02d:%02d", offset.minutes < 0 ? '-' : '+',
                minutes / 60, minutes % 60);
  return text.data();
}

std::optional<UtcOffset> OffsetOf(std::string_view time) {
  const Result<scene::ZonedTime> zoned = scene::ParseZonedTime(time);
  if (!zoned || !zoned->offset) return std::nullopt;
  const auto minutes = std::chrono::round<std::chrono::minutes>(*zoned->offset);
  if (std::chrono::abs(minutes) >= std::chrono::hours(kMaxHours + 1)) return std::nullopt;
  return UtcOffset{static_cast<int>(minutes.count())};
}

UtcOffset NauticalOffset(double longitude_deg) {
  const double east = std::remainder(longitude_deg, 360.0);
  return {60 * static_cast<int>(std::lround(east / 15.0))};
}

Result<UtcTime> ParseDay(std::string_view date, std::optional<UtcOffset> offset,
                         const std::string& option) {
  constexpr std::string_view kForm = "2025-06-21";
  if (date.size() != kForm.size()) {
    return InputError(option, "\"" + std::string(date.substr(0, 40)) + "\" is not a date",
                      "write it as " + std::string(kForm));
  }
  const Result<UtcTime> midnight = UtcTime::Parse(std::string(date) + "T00:00:00Z");
  if (!midnight) {
    Error error = About(midnight.error(), option);
    error.what = "\"" + std::string(date) + "\" is not a day of the years 1678 to 2261";
    error.remedy = "write it as " + std::string(kForm);
    return tl::make_unexpected(std::move(error));
  }
  if (!offset) {
    return InputError(option, "the clock's offset from UTC is not given",
                      "give --utc-offset too, for example --utc-offset +02:00");
  }
  return midnight->PlusSeconds(-offset->seconds());
}

std::string FormatLocal(UtcTime time, UtcOffset offset) {
  constexpr std::int64_t kSecond = pleinair::internal::kNanosecondsPerSecond;
  const std::int64_t ns = time.PlusSeconds(offset.seconds()).nanoseconds_since_1970();
  const std::int64_t rounded = (ns + (ns < 0 ? -kSecond : kSecond) / 2) / kSecond * kSecond;
  std::string text = UtcTime(rounded).ToString();
  text.pop_back();  // The Z.
  return text + ToString(offset);
}

std::string FormatLocalDate(UtcTime time, UtcOffset offset) {
  return time.PlusSeconds(offset.seconds()).ToString().substr(0, 10);
}

Result<UtcTime> ParseTimeOption(const std::string& option, std::string_view text) {
  Result<scene::ZonedTime> zoned = scene::ParseZonedTime(text);
  if (zoned) return zoned->time;
  // System errors keep their own location.
  if (zoned.error().kind == ErrorKind::kSystem) {
    return tl::make_unexpected(std::move(zoned).error());
  }
  return tl::make_unexpected(About(std::move(zoned).error(), option));
}

}  // namespace pleinair::app
