#pragma once

#include <optional>
#include <string_view>

#include "base/utc_time.h"

namespace pleinair::content {

/// A unit of time as CF conventions write it, "hours since 1900-01-01 00:00:0.0".
struct CfTimeUnit {
  double seconds = 1.0;          ///< Of one unit.
  std::optional<UtcTime> since;  ///< Unset: the moment is no date that UtcTime has.
};

/// Unset: no unit of time since a moment.
std::optional<CfTimeUnit> ParseCfTimeUnit(std::string_view text);

}  // namespace pleinair::content
