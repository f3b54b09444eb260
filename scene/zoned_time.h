#pragma once

#include <chrono>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/utc_time.h"

namespace pleinair::scene {

/// A time as the user wrote it.
struct ZonedTime {
  UtcTime time;
  /// Local time minus UTC, east positive. Unset after `Z` without a zone, because the local offset
  /// is then unknown.
  std::optional<std::chrono::seconds> offset;
};

/// Parses RFC 3339 with `Z` or an offset (UtcTime::Parse), and local time with its IANA zone:
/// "2025-09-14T13:05:00[Europe/Prague]". Both may be given, as in RFC 9557:
/// "2025-09-14T13:05:00+02:00[Europe/Prague]"; `Z` before a zone means UTC. Errors (input): neither
/// offset nor zone; an unknown zone; an offset that the zone does not have at that time; a clock
/// reading that a clock change skips or repeats; a time beyond the machine's zone data. Errors
/// (system): the machine has no zone data, or it cannot be read.
Result<ZonedTime> ParseZonedTime(std::string_view text);

}  // namespace pleinair::scene
