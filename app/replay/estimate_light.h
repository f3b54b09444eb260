#pragma once

#include <memory>

#include "app/replay/replay_state.h"
#include "compositor/light/daylight/daylight_coefficients.h"

namespace pleinair::app {

/// Estimates heading, sun and sky from some frames.
Result<void> EstimateLight(ReplayState& state);

/// Measures focus and aperture on the marker, where they are neither stated nor recorded and
/// objects are to be drawn. A failure to measure is a warning if it was asked for.
Result<void> MeasureLens(ReplayState& state);

/// Computes the light of the first frame before compositing, with its own progress bar.
Result<void> TraceLight(ReplayState& state);

/// Returns the scene's daylight coefficients. Shows a progress bar if they must be computed.
std::shared_ptr<const compositor::DaylightCoefficients> TraceCoefficients(ReplayState& state);

}  // namespace pleinair::app
