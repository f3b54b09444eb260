#include "app/sun_over_place.h"

namespace pleinair::app {

sky::SunPosition SunOver(const devices::PlaceTime& place, UtcTime time) {
  const sky::Observer observer{FromDegrees(place.latitude_deg), FromDegrees(place.longitude_deg),
                               Metres(place.height_m)};
  return sky::ComputeSunPosition(observer, time);
}

}  // namespace pleinair::app
