#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/utc_time.h"

namespace pleinair::app {

/// Local time minus UTC by an ordinary clock: whole minutes, east positive.
struct UtcOffset {
  int minutes = 0;
  double seconds() const { return 60.0 * minutes; }
  bool operator==(const UtcOffset&) const = default;
};

/// Parses "+02:00", "-9:30", "+5", "Z", up to 15:59 in both directions. Errors (input), about
/// `option`: other text.
Result<UtcOffset> ParseUtcOffset(std::string_view text, const std::string& option);

/// "+02:00"; "Z" for zero.
std::string ToString(UtcOffset offset);

/// Returns the offset of a time, from its end or its zone. Nothing after Z, which does not give the
/// observer's clock. Nothing for offsets beyond 15:59 or if ParseTimeOption() fails.
std::optional<UtcOffset> OffsetOf(std::string_view time);

/// The whole hour nearest to local mean solar time.
UtcOffset NauticalOffset(double longitude_deg);

/// Returns the midnight at which the calendar day "2025-06-21" begins on the clock of `offset`.
/// Errors (input): no such day; no offset, because the day would be ambiguous.
Result<UtcTime> ParseDay(std::string_view date, std::optional<UtcOffset> offset,
                         const std::string& option);

/// The time on a local clock, rounded to the second: "2025-06-21T04:52:10+02:00".
std::string FormatLocal(UtcTime time, UtcOffset offset);

/// Only the date: "2025-06-21".
std::string FormatLocalDate(UtcTime time, UtcOffset offset);

/// Parses RFC 3339 with an offset or Z, or a local time with its zone. Errors: as
/// scene/zoned_time.h, about `option`.
Result<UtcTime> ParseTimeOption(const std::string& option, std::string_view text);

}  // namespace pleinair::app
