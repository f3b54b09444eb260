#pragma once

#include <string>

#include "compositor/photometry/measured_light.h"

namespace pleinair::app {

// Text of the panel for the light estimates, each with its uncertainty (one standard deviation).
// Empty if there is no estimate.

/// `drawn`: sun and sky that light the image. `measured`: the estimate, with its source and
/// uncertainty.
std::string MeasuredSunText(const compositor::MeasuredLight& drawn,
                            const compositor::MeasuredLight& measured);

std::string MeasuredHeadingText(const compositor::MeasuredLight& measured);

}  // namespace pleinair::app
