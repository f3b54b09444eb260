#pragma once

#include "base/vector.h"
#include "devices/scene_description.h"

namespace pleinair::app {

/// Marker coordinates from east-north-up, from the marker's stated heading (devices/
/// scene_description.h).
Mat3 MarkerFromWorld(const devices::MarkerDescription& marker);

}  // namespace pleinair::app
