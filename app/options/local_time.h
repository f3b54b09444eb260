#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/utc_time.h"

namespace pleinair::app {

/// Local time minus UTC, as a person's clock has it: whole minutes, east positive.
struct UtcOffset {
  int minutes = 0;
  double seconds() const { return 60.0 * minutes; }
  bool operator==(const UtcOffset&) const = default;
};

/// "+02:00", "-9:30", "+5", "Z", up to 15:59 either way. Errors (input): anything else, `option`
/// being named.
Result<UtcOffset> ParseUtcOffset(std::string_view text, const std::string& option);

/// "+02:00"; "Z" where it is nothing.
std::string ToString(UtcOffset offset);

/// The offset that a time has at its end or by its zone; nothing after Z, which says nothing of the
/// clocks where the observer stands, for offsets beyond 15:59, and where ParseTimeOption() fails.
std::optional<UtcOffset> OffsetOf(std::string_view time);

/// The whole hour nearest to local mean solar time.
UtcOffset NauticalOffset(double longitude_deg);

/// Midnight at which the calendar day "2025-06-21" begins on the clock of `offset`. Errors (input):
/// no such day; no offset, since nobody can know whose day is meant.
Result<UtcTime> ParseDay(std::string_view date, std::optional<UtcOffset> offset,
                         const std::string& option);

/// The time on a local clock, to the nearest second: "2025-06-21T04:52:10+02:00".
std::string FormatLocal(UtcTime time, UtcOffset offset);

/// The date alone: "2025-06-21".
std::string FormatLocalDate(UtcTime time, UtcOffset offset);

/// RFC 3339 with an offset or Z, or a local time with its zone (scene/zoned_time.h), whose errors
/// it has. `option` is named.
Result<UtcTime> ParseTimeOption(const std::string& option, std::string_view text);

}  // namespace pleinair::app
