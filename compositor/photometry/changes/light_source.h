#pragma once

// Internal: between .cc files.

#include "compositor/photometry/changes/light_changes.h"
#include "compositor/photometry/changes/light_walk.h"

namespace pleinair::compositor {

/// Product with a frame's light: log(sun over sky), mean of the channels.
LogLight RatioDirection();

/// Standard deviation of log(sun over sky) for an error of the modelled sun over sky that all
/// probes have in common. With an error e of their share, the same brightness means a sun of
/// a + e (1 - a) of the full sun.
double CommonModelError(double log_ratio);

/// What tells sun and sky of a frame apart. `told`: inverse covariance of its light by its readings
/// alone. `log_ratio_error`: that of the estimate.
FrameLight::Source SourceOf(const LogLightMatrix& told, double log_ratio_error);

}  // namespace pleinair::compositor
