#pragma once

#include "base/units.h"
#include "base/utc_time.h"
#include "compositor/photometry/light_filter.h"
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

/// The heading of a scene description.
struct StatedHeading {
  Radians heading;
  bool is_final = false;  ///< The user's own: no measurement changes it.
};

/// Sets the heading to the stated one with the offset that the filter has measured, if any.
void UseHeading(StatedHeading stated, const LightFilter& light_filter, UtcTime time,
                LightEstimate* found);

}  // namespace pleinair::compositor
