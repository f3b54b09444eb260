#pragma once

// Internal: reached through scene/zoned_time.h.

#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/utc_time.h"

namespace pleinair::scene {

/// The offsets from UTC that a clock reading may have in a zone.
struct LocalOffsets {
  enum class Kind {
    kOnce,   ///< An ordinary moment: both offsets are its own.
    kNever,  ///< Skipped when clocks were set forward from `first` to `second`.
    kTwice,  ///< Shown at `first`, then again at `second`, after clocks were set back.
  };
  Kind kind = Kind::kOnce;
  std::chrono::seconds first{}, second{};  ///< Local time minus UTC, east positive.
};

/// A zone of the machine's IANA time-zone database (Debian: tzdata).
class TimeZone {
 public:
  /// Errors (input): no such zone; the message suggests near names. Errors (system): the machine
  /// has no database, or the zone's file cannot be read.
  static Result<TimeZone> Find(std::string_view name);

  const std::string& name() const { return name_; }

  /// Local time minus UTC at a moment. Errors (input): the database ends before it. Errors
  /// (system): the zone's file cannot be read.
  Result<std::chrono::seconds> OffsetAt(UtcTime time) const;

  /// The offsets of a clock reading, given as if it were UTC. Errors as OffsetAt().
  Result<LocalOffsets> OffsetsOfReading(UtcTime reading) const;

 private:
  TimeZone(std::string name, bool keeps_changing)
      : name_(std::move(name)), keeps_changing_(keeps_changing) {}

  std::string name_;
  bool keeps_changing_;  ///< Clocks change every year, also after the database's last entry.
};

}  // namespace pleinair::scene
