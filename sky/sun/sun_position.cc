#include "sky/sun/sun_position.h"

#include <cmath>

#include "sky/sun/refraction.h"
#include "sky/sun/sun_models.h"

namespace pleinair::sky {

Direction<World> SunPosition::ToSun() const {
  const double horizontal = std::cos(elevation_refracted.value());
  return {{horizontal * std::sin(azimuth.value()), horizontal * std::cos(azimuth.value()),
           std::sin(elevation_refracted.value())}};
}

Radians SunPosition::AngularRadius() const {
  // Auwers 1891, the value used by the almanacs.
  return FromDegrees(959.63 / 3600.0 / distance_au);
}

SunPosition ComputeSunPosition(const Observer& observer, UtcTime time, SunModel model) {
  const internal::AirlessSun sun = model == SunModel::kPaper || !HasPreciseSun()
                                       ? internal::PaperSun(observer, time)
                                       : internal::PreciseSun(observer, time);
  SunPosition position;
  position.azimuth = Radians(sun.azimuth_rad);
  position.elevation = Radians(sun.elevation_rad);
  position.elevation_refracted =
      position.elevation +
      Refraction(position.elevation, observer.pressure_mbar, observer.temperature_c);
  position.distance_au = sun.distance_au;
  return position;
}

}  // namespace pleinair::sky
