#pragma once

#include "base/utc_time.h"
#include "scene/scene_description.h"
#include "sky/sun/sun_position.h"

namespace pleinair::scene {

/// The sun over a place at a moment.
sky::SunPosition SunOver(const PlaceTime& place, UtcTime time);

}  // namespace pleinair::scene
