#pragma once

#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::compositor {

/// A small place on one material, in the sun as far as the phantoms go, of which a shadow's edge
/// shows that a part is not.
struct ShadowCrossing {
  Point<Marker> middle;
  Vec3 normal;         ///< Of its surface, unit, marker coordinates, towards the eye.
  LinearRgb contrast;  ///< Logarithm of the bright part's light over the dark one's, a channel.
};

}  // namespace pleinair::compositor
