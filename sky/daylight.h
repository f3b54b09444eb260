#pragma once

#include <memory>

#include "sky/sky_model.h"
#include "sky/standard_illuminance.h"

namespace pleinair::sky {

/// A day's sky, described in everyday terms.
struct DaylightOptions {
  SkyCondition condition = SkyCondition::kClear;
  /// 0: the condition's default. Otherwise clamped to kMinTurbidity…kMaxTurbidity. Has little
  /// effect under an overcast sky.
  double turbidity = 0.0;
};

/// The sky source of such a day, by the kAtmosphere model:
/// - clear: kDefaultTurbidity;
/// - hazy: turbidity 3.2, whose diffuse share is 0.40 at a sun elevation of 30°;
/// - partly cloudy: cloud cover 0.6;
/// - overcast: cloud cover 1, no direct sun.
std::shared_ptr<const SkySource> CreateDaylight(const DaylightOptions& options);

}  // namespace pleinair::sky
