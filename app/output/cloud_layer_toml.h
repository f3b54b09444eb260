#pragma once

#include <string>

#include "sky/clouds/cloud_layer.h"

namespace pleinair::app {

/// The table [[cloud_layer]] of a scene, with all keys. Reading it gives the same layer.
std::string CloudLayerToml(const clouds::CloudLayer& layer);

}  // namespace pleinair::app
