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
/// radiance in cd/m², irradiance in lux, so that Luminance(rgb) is the photometric figure.
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
  double turbidity = 0.0;  ///< 0: the condition's default.
};

/// Perez/Preetham colours and gradient, scaled to the IES illuminances of the condition; the CIE
/// overcast gradient for an overcast sky.
std::unique_ptr<Daylight> CreateDaylight(const SunPosition& sun, const DaylightOptions& options);

}  // namespace pleinair::sky
