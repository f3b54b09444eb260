#pragma once

// Internal: used through scene/zoned_time.h.

#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/utc_time.h"

namespace pleinair::scene {

/// The UTC offsets that a local clock reading can have in a zone.
struct LocalOffsets {
  enum class Kind {
    kOnce,   ///< The usual case: both offsets are the same.
    kNever,  ///< Skipped, when clocks were set forward from `first` to `second`.
    kTwice,  ///< Repeated: shown at `first`, then again at `second`, after clocks were set back.
  };
  Kind kind = Kind::kOnce;
  std::chrono::seconds first{}, second{};  ///< Local time minus UTC, east positive.
};

/// A zone of the machine's IANA time-zone database (Debian: tzdata).
class TimeZone {
 public:
  /// Errors (input): no such zone; the message suggests similar names. Errors (system): the machine
  /// has no database, or the zone's file cannot be read.
  static Result<TimeZone> Find(std::string_view name);

  const std::string& name() const { return name_; }

  /// Local time minus UTC at a time. Errors (input): the time lies beyond the end of the database.
  /// Errors (system): the zone's file cannot be read.
  Result<std::chrono::seconds> OffsetAt(UtcTime time) const;

  /// The offsets of a local clock reading, which is passed as if it were UTC. Errors as OffsetAt().
  Result<LocalOffsets> OffsetsOfReading(UtcTime reading) const;

 private:
  TimeZone(std::string name, bool keeps_changing)
      : name_(std::move(name)), keeps_changing_(keeps_changing) {}

  std::string name_;
  bool keeps_changing_;  ///< Daylight-saving time goes on after the database's last entry.
};

}  // namespace pleinair::scene
