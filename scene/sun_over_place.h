#pragma once

#include "base/utc_time.h"
#include "scene/scene_description.h"
#include "sky/sun/sun_position.h"

namespace pleinair::scene {

/// Position of the sun over a place at a time.
sky::SunPosition SunOver(const PlaceTime& place, UtcTime time);

}  // namespace pleinair::scene
