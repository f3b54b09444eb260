#pragma once

#include <string>

#include "app/measured_sky.h"

namespace pleinair::app {

// What the panel says of what frames have told, each with its uncertainty (one standard deviation);
// empty where they have not told.

/// `drawn`: sun and sky that the picture is lit by; `measured`: from what, and how well.
std::string MeasuredSunText(const MeasuredLight& drawn, const MeasuredLight& measured);

std::string MeasuredHeadingText(const MeasuredLight& measured);

}  // namespace pleinair::app
