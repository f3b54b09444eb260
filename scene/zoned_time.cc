#include "scene/zoned_time.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>

#include "scene/time_zone.h"

namespace pleinair::scene {
namespace {

using std::chrono::seconds;

constexpr std::size_t kMaxZoneName = 64;
constexpr std::size_t kSecondsDigits = 17;  // Position of the seconds in "2025-09-14T11:05:00".
constexpr const char* kForm = "write it as 2025-09-14T13:05:00[Europe/Prague]";

std::string TwoDigits(std::int64_t number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

/// "+02:00"; with seconds for zones that used local mean time.
std::string OffsetText(seconds offset) {
  const std::int64_t total = std::abs(offset.count());
  std::string text = offset.count() < 0 ? "-" : "+";
  text += TwoDigits(total / 3600) + ":" + TwoDigits(total / 60 % 60);
  return total % 60 == 0 ? text : text + ":" + TwoDigits(total % 60);
}

/// The offset at the end of an RFC 3339 time that UtcTime::Parse() has accepted; nullopt after Z.
std::optional<seconds> WrittenOffset(std::string_view rfc3339) {
  if (rfc3339.back() == 'Z' || rfc3339.back() == 'z') return std::nullopt;
  const std::string_view text = rfc3339.substr(rfc3339.size() - 6);
  const auto number = [&](std::size_t at) { return 10 * (text[at] - '0') + text[at + 1] - '0'; };
  return seconds((text[0] == '-' ? -60 : 60) * (60 * number(1) + number(4)));
}

/// RFC 3339 offsets have minutes only; before 1900 some zones had offsets with seconds.
seconds InMinutes(seconds offset) { return std::chrono::round<std::chrono::minutes>(offset); }

/// A text of the form "local time[zone]", with its parts and messages.
class BracketedTime {
 public:
  BracketedTime(std::string_view clock, TimeZone zone) : clock_(clock), zone_(std::move(zone)) {}

  Result<ZonedTime> Read() const {
    if (const Result<UtcTime> time = UtcTime::Parse(clock_)) return ReadWithOffset(*time);
    // The local clock reading, as if it were UTC.
    const Result<UtcTime> reading = UtcTime::Parse(clock_ + "Z");
    if (!reading) return tl::make_unexpected(UtcTime::Parse(clock_).error());
    if (clock_.compare(kSecondsDigits, 2, "60") == 0) {
      return Fail("names a second 60, which only UTC has", "write it in UTC, with Z");
    }
    return ReadWithoutOffset(*reading);
  }

 private:
  Result<ZonedTime> ReadWithOffset(UtcTime time) const {
    const Result<seconds> offset = zone_.OffsetAt(time);
    if (!offset) return Explain(offset.error());
    const std::optional<seconds> written = WrittenOffset(clock_);
    if (written && *written != InMinutes(*offset)) {
      return Fail("has the offset " + OffsetText(*written) + ", but " + zone_.name() + " was at " +
                      OffsetText(*offset) + " then",
                  "leave out the offset or the zone");
    }
    return ZonedTime{time, *offset};
  }

  Result<ZonedTime> ReadWithoutOffset(UtcTime reading) const {
    const Result<LocalOffsets> offsets = zone_.OffsetsOfReading(reading);
    if (!offsets) return Explain(offsets.error());
    const std::string first = OffsetText(offsets->first);
    const std::string second = OffsetText(offsets->second);
    switch (offsets->kind) {
      case LocalOffsets::Kind::kOnce:
        break;
      case LocalOffsets::Kind::kNever: {
        const seconds skipped = offsets->second - offsets->first;
        return Fail("does not exist: clocks were set forward from " + first + " to " + second,
                    "write " + Shifted(reading, -skipped) + " before the change, or " +
                        Shifted(reading, skipped) + " after it");
      }
      case LocalOffsets::Kind::kTwice:
        return Fail(
            "occurred twice: at " + first + ", and at " + second + " after clocks were set back",
            "write " + WithOffset(offsets->first) + " or " + WithOffset(offsets->second));
    }
    return ZonedTime{At(reading, -offsets->first), offsets->first};
  }

  static UtcTime At(UtcTime time, seconds later) {
    return UtcTime(time.nanoseconds_since_1970() + std::chrono::nanoseconds(later).count());
  }

  std::string Shifted(UtcTime reading, seconds later) const {
    std::string text = At(reading, later).ToString();
    text.pop_back();  // Drops the Z.
    return Bracketed(text);
  }

  std::string WithOffset(seconds offset) const {
    return Bracketed(clock_ + OffsetText(InMinutes(offset)));
  }

  std::string Bracketed(const std::string& clock) const { return clock + "[" + zone_.name() + "]"; }

  tl::unexpected<Error> Fail(const std::string& what, std::string remedy) const {
    return InputError("", "time \"" + Bracketed(clock_).substr(0, 128) + "\" " + what,
                      std::move(remedy));
  }

  /// Adapts an error of the zone lookup; only input errors concern the time.
  tl::unexpected<Error> Explain(Error error) const {
    if (error.kind != ErrorKind::kInput) return tl::make_unexpected(std::move(error));
    return Fail(error.what, std::move(error.remedy));
  }

  std::string clock_;
  TimeZone zone_;
};

/// Plain RFC 3339. If only the offset is missing, the message suggests a zone as well.
Result<ZonedTime> ParseWithoutZone(std::string_view text) {
  Result<UtcTime> time = UtcTime::Parse(text);
  if (time) return ZonedTime{*time, WrittenOffset(text)};
  if (UtcTime::Parse(std::string(text) + "Z")) {
    time.error().remedy =
        "add its offset, " + std::string(text.substr(0, 40)) +
        "+02:00, or Z for UTC, or name its zone, for example 2025-09-14T13:05:00[Europe/Prague]";
  }
  return tl::make_unexpected(std::move(time).error());
}

}  // namespace

Result<ZonedTime> ParseZonedTime(std::string_view text) {
  const std::size_t bracket = text.find('[');
  if (bracket == std::string_view::npos) return ParseWithoutZone(text);
  const auto fail = [&](const std::string& what, std::string remedy) {
    return InputError("", "time \"" + std::string(text.substr(0, 128)) + "\" " + what,
                      std::move(remedy));
  };
  const std::string_view name = text.substr(bracket + 1, text.size() - bracket - 2);
  if (text.back() != ']' || name.find_first_of("[]") != std::string_view::npos) {
    return fail("does not end with a zone in brackets", kForm);
  }
  if (name.empty() || name.size() > kMaxZoneName) {
    return fail("has no name of a zone in its brackets", kForm);
  }
  Result<TimeZone> zone = TimeZone::Find(name);
  if (!zone) {
    Error error = std::move(zone).error();
    if (error.kind != ErrorKind::kInput) return tl::make_unexpected(std::move(error));
    return fail(error.what, std::move(error.remedy));
  }
  return BracketedTime(text.substr(0, bracket), *std::move(zone)).Read();
}

}  // namespace pleinair::scene
