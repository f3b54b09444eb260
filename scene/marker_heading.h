#pragma once

#include "base/vector.h"
#include "scene/scene_description.h"

namespace pleinair::scene {

/// Rotation from east-north-up (World) to marker coordinates, from the heading in the scene
/// description.
Mat3 MarkerFromWorld(const MarkerDescription& marker);

}  // namespace pleinair::scene
