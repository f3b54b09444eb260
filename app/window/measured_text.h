#pragma once

#include <string>

#include "compositor/photometry/measured_light.h"

namespace pleinair::app {

// What the panel says of what frames have told, each with its uncertainty (one standard deviation);
// empty where they have not told.

/// `drawn`: sun and sky that the picture is lit by; `measured`: from what, and how well.
std::string MeasuredSunText(const compositor::MeasuredLight& drawn,
                            const compositor::MeasuredLight& measured);

std::string MeasuredHeadingText(const compositor::MeasuredLight& measured);

}  // namespace pleinair::app
