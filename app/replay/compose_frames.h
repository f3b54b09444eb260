#pragma once

#include "app/replay/replay_state.h"

namespace pleinair::app {

/// Composites all frames: composite.mp4, frames/ and the images of the report.
Result<void> ComposeFrames(ReplayState& state);

}  // namespace pleinair::app
