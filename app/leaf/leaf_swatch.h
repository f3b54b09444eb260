#pragma once

#include "base/image.h"
#include "scene/leaf_contents.h"

namespace pleinair::app {

/// Draws both sides of a leaf under D65. The sunlit side is on the left. The side away from the
/// light is on the right: it shows what the leaf transmits. The frame is a white diffuser in the
/// same light.
RgbImage LeafSwatch(const scene::Leaf& leaf);

}  // namespace pleinair::app
