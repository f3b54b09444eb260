#pragma once

#include <string>

#include "compositor/photometry/measured_light.h"

namespace pleinair::app {

/// How the frames contradict the described sun and sky.
enum class LightContradiction {
  kNone,
  kNoSunlight,        ///< No surface is lit by the described sun.
  kShadowsMissing,    ///< No shadow lies where the described sun would cast one.
  kShadowsVisible,    ///< Phantoms cast shadows below a sky that is described without a sun.
  kMarkerDivided,     ///< The same, by a shadow edge on the marker.
  kShadowsElsewhere,  ///< Shadows lie elsewhere than the described sun would cast them.
  kSunElsewhere       ///< The same, and they fit a sun elsewhere.
};

LightContradiction ContradictionOf(const compositor::MeasuredLight& light);

/// What the frames show, as a clause that begins in lower case. Empty for kNone.
std::string SeenText(LightContradiction contradiction, const compositor::MeasuredLight& light);

}  // namespace pleinair::app
