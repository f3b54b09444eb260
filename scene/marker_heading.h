#pragma once

#include "base/vector.h"
#include "scene/scene_description.h"

namespace pleinair::scene {

/// Marker coordinates from east-north-up, from the marker's stated heading (devices/
/// scene_description.h).
Mat3 MarkerFromWorld(const MarkerDescription& marker);

}  // namespace pleinair::scene
