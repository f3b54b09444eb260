#pragma once

#include <memory>

#include "sky/sky_model.h"
#include "sky/standard_illuminance.h"
#include "sky/sun_position.h"

namespace pleinair::sky {

struct DaylightOptions {
  SkyCondition condition = SkyCondition::kClear;
  /// 0: the condition's default. Otherwise clamped to what PerezSky allows; without effect under
  /// an overcast sky.
  double turbidity = 0.0;
};

/// The light of a moment, continuous from noon to night.
/// - Clear and hazy: pattern and colours of PerezSky, colour of DirectSunIrradiance, both scaled to
///   ComputeStandardIlluminance.
/// - Partly cloudy: half the light of a clear sky (at dusk half of what there is), the rest from
///   clouds: even and neutral; the sun's colour is that of the clear air, its strength IES'.
/// - Overcast: no sun; CIE standard general sky type 1 (ISO 15469:2004), neutral (D65).
std::unique_ptr<SkyModel> CreateDaylight(const SunPosition& sun, const DaylightOptions& options);

}  // namespace pleinair::sky
