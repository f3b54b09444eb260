#pragma once

#include <optional>
#include <string>

#include "app/options/local_time.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "sky/sun/sun_position.h"

namespace pleinair::app {

/// How the tables are written.
struct SunDayOptions {
  sky::SunModel model = sky::SunModel::kPrecise;
  bool json = false;
  std::string output;  ///< Empty: standard output.
};

/// The sun of a moment and its rise, noon, set and twilights: of the noon nearest to the middle of
/// the calendar day at `calendar`, or without it of the local mean solar day. `clock` is the offset
/// of the times written.
Result<void> WriteSunMoment(const sky::Observer& observer, UtcTime time,
                            std::optional<UtcOffset> calendar, UtcOffset clock,
                            const SunDayOptions& options);

/// All that the sun does between two midnights of a clock: each passage in time's order, also where
/// the day holds two sunsets or none.
Result<void> WriteSunDay(const sky::Observer& observer, UtcTime midnight, UtcOffset offset,
                         const SunDayOptions& options);

/// A row a day as CSV (or an object a day), `days` of them.
Result<void> WriteSunAlmanac(const sky::Observer& observer, UtcTime midnight, UtcOffset offset,
                             int days, const SunDayOptions& options);

}  // namespace pleinair::app
