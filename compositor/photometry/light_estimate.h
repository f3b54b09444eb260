#pragma once

#include "base/units.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/photometry/sky_state.h"

namespace pleinair::compositor {

/// Light that was estimated from frames.
struct LightEstimate {
  MeasuredLight measured;
  Radians heading;  ///< Heading of the marker.
  /// A null source means that no frame gave an estimate: the scene description applies.
  SkyState skies;
};

}  // namespace pleinair::compositor
