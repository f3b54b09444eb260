#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/utc_time.h"
#include "sky/sun/sun_day.h"
#include "sky/sun/sun_position.h"

namespace pleinair::sky {

/// Whether the sun passes an elevation on its day.
enum class SunPresence {
  kPasses,     ///< At least once, upwards or downwards.
  kStaysUp,    ///< Always above; for the horizon: polar day.
  kStaysDown,  ///< Always below; for the horizon: polar night.
};

/// A solar day: from one lower transit ("midnight") to the next, with the noon between.
struct SunEvents {
  /// Upper limb on the sea's horizon (SunHorizon::kSunrise); nothing in polar day and night.
  std::optional<UtcTime> sunrise;
  UtcTime noon;  ///< Upper transit: the sun crosses the meridian from east to west.
  std::optional<UtcTime> sunset;
  /// By SunHorizon: when the sun rises through that elevation before noon, and sets through it
  /// after noon (for kSunrise: sunrise and sunset). Unset where it does not.
  std::array<std::optional<UtcTime>, kSunHorizons> dawns, dusks;
  std::array<SunPresence, kSunHorizons> presences{};

  std::optional<UtcTime> Dawn(SunHorizon h) const { return dawns[static_cast<std::size_t>(h)]; }
  std::optional<UtcTime> Dusk(SunHorizon h) const { return dusks[static_cast<std::size_t>(h)]; }
  SunPresence Presence(SunHorizon h) const { return presences[static_cast<std::size_t>(h)]; }
};

/// Events around the noon nearest to the middle of the local mean solar day that contains `time`.
/// To 0.1 s of the model.
SunEvents ComputeSunEvents(const Observer& observer, UtcTime time,
                           SunModel model = SunModel::kPrecise);

/// The middle of the day that contains `time`, on a clock that shows UTC + `offset_s`.
UtcTime MiddleOfDay(UtcTime time, double offset_s);

/// Events around the noon nearest to `middle`, the middle of the requested day.
SunEvents ComputeSunEventsNear(const Observer& observer, UtcTime middle,
                               SunModel model = SunModel::kPrecise);

}  // namespace pleinair::sky
