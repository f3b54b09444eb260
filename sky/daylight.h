#pragma once

#include <memory>

#include "base/frames.h"
#include "base/units.h"
#include "base/vector.h"
#include "sky/sun_position.h"

namespace pleinair::sky {

/// How clear the sky is; decides the default turbidity and the sun's and sky's illuminance.
enum class SkyCondition { kClear, kHazy, kPartlyCloudy, kOvercast };

/// The light of one moment: sun and sky, in linear Rec.709 with absolute photometric scale:
/// radiance in cd/m², irradiance in lux, so that Luminance(rgb) is the photometric figure. No
/// channel is ever negative. Safe to ask from several threads at once.
class Daylight {
 public:
  virtual ~Daylight() = default;

  /// Sky radiance (without the sun's disc) from a direction of the upper hemisphere; zero below.
  virtual LinearRgb SkyRadiance(Direction<World> from) const = 0;

  /// The sun's illuminance on a surface facing it; zero below the horizon.
  virtual LinearRgb SunNormalIrradiance() const = 0;

  /// The sky's illuminance on level ground.
  virtual LinearRgb SkyHorizontalIrradiance() const = 0;

  virtual Direction<World> ToSun() const = 0;
};

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
std::unique_ptr<Daylight> CreateDaylight(const SunPosition& sun, const DaylightOptions& options);

}  // namespace pleinair::sky
