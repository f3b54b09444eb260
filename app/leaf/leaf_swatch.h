#pragma once

#include "base/image.h"
#include "scene/leaf_contents.h"

namespace pleinair::app {

/// A picture of a leaf under D65: its sunlit side on the left, and on the right the side away from
/// the light, which shows what the leaf transmits. The frame is a white diffuser in the same light.
RgbImage LeafSwatch(const scene::Leaf& leaf);

}  // namespace pleinair::app
