#pragma once

#include "app/replay/replay_state.h"

namespace pleinair::app {

/// Composes all frames: composite.mp4, frames/ and the pictures of the report.
Result<void> ComposeFrames(ReplayState& state);

}  // namespace pleinair::app
