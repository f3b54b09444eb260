#pragma once

#include <memory>

#include "app/replay/replay_state.h"
#include "compositor/light/daylight/daylight_coefficients.h"

namespace pleinair::app {

/// Reads heading, sun and sky from some frames.
Result<void> EstimateLight(ReplayState& state);

/// Traces the light of the first frame, before frames are composed, so that it has a bar of its
/// own.
Result<void> TraceLight(ReplayState& state);

/// The scene's daylight coefficients, with a bar where they are traced.
std::shared_ptr<const compositor::DaylightCoefficients> TraceCoefficients(ReplayState& state);

}  // namespace pleinair::app
