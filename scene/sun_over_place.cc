#include "scene/sun_over_place.h"

namespace pleinair::scene {

sky::SunPosition SunOver(const PlaceTime& place, UtcTime time) {
  const sky::Observer observer{FromDegrees(place.latitude_deg), FromDegrees(place.longitude_deg),
                               Metres(place.height_m)};
  return sky::ComputeSunPosition(observer, time);
}

}  // namespace pleinair::scene
