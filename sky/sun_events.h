#pragma once

#include <optional>

#include "base/utc_time.h"
#include "sky/sun_position.h"

namespace pleinair::sky {

/// The sun's day.
struct SunEvents {
  /// Upper limb on the sea's horizon (airless elevation −0.8333° of the centre, as in the
  /// almanacs); nothing in polar day and night.
  std::optional<UtcTime> sunrise;
  UtcTime noon;  ///< Upper transit: the sun crosses the meridian from east to west.
  std::optional<UtcTime> sunset;
};

/// Noon of the local mean solar day in which `time` lies, the sunrise in the twelve hours before
/// and the sunset in the twelve hours after it. To 0.1 s of the model.
SunEvents ComputeSunEvents(const Observer& observer, UtcTime time,
                           SunModel model = SunModel::kPrecise);

}  // namespace pleinair::sky
