#pragma once

#include <optional>
#include <string>

#include "app/options/local_time.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::app {

/// Options for writing the tables.
struct SunDayOptions {
  sky::SunModel model = sky::SunModel::kPrecise;
  bool json = false;
  std::string output;  ///< Empty: standard output.
};

/// Writes the sun's position at a time with its rise, noon, set and twilights. They belong to the
/// noon nearest to the middle of a day. With `calendar` it is the calendar day at this offset,
/// otherwise the local mean solar day. `clock` is the offset of the written times.
Result<void> WriteSunMoment(const sky::Observer& observer, UtcTime time,
                            std::optional<UtcOffset> calendar, UtcOffset clock,
                            const SunDayOptions& options);

/// Writes all events of the sun between two midnights of a clock: each passage in order of time,
/// also on days with two sunsets or none.
Result<void> WriteSunDay(const sky::Observer& observer, UtcTime midnight, UtcOffset offset,
                         const SunDayOptions& options);

/// Writes `days` rows of CSV (or objects), one per day.
Result<void> WriteSunAlmanac(const sky::Observer& observer, UtcTime midnight, UtcOffset offset,
                             int days, const SunDayOptions& options);

}  // namespace pleinair::app
