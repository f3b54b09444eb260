#pragma once

#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::compositor {

/// Small place on one material that the phantoms leave sunlit. A shadow boundary shows that a part
/// of it is shaded.
struct ShadowCrossing {
  Point<Marker> middle;
  Vec3 normal;         ///< Of its surface, unit, marker coordinates, towards the eye.
  LinearRgb contrast;  ///< Logarithm of the bright part's light over the dark part's, per channel.
};

}  // namespace pleinair::compositor
