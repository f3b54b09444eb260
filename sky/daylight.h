#pragma once

#include <memory>

#include "sky/sky_model.h"
#include "sky/standard_illuminance.h"

namespace pleinair::sky {

/// A day as people describe it.
struct DaylightOptions {
  SkyCondition condition = SkyCondition::kClear;
  /// 0: the condition's default. Otherwise clamped to kMinTurbidity…kMaxTurbidity; hardly
  /// matters under an overcast sky.
  double turbidity = 0.0;
};

/// The skies of such a day, of kAtmosphere:
/// - clear: kDefaultTurbidity;
/// - hazy: turbidity 3.2, which at a sun of 30° has a diffuse share of 0.40;
/// - partly cloudy: cloud cover 0.6;
/// - overcast: cloud cover 1, no sun.
std::shared_ptr<const SkySource> CreateDaylight(const DaylightOptions& options);

}  // namespace pleinair::sky
