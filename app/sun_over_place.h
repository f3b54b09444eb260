#pragma once

#include "base/utc_time.h"
#include "devices/scene_description.h"
#include "sky/sun_position.h"

namespace pleinair::app {

/// The sun over a place at a moment.
sky::SunPosition SunOver(const devices::PlaceTime& place, UtcTime time);

}  // namespace pleinair::app
