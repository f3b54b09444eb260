#pragma once

#include "app/replay/replay_state.h"

namespace pleinair::app {

/// Finds the markers of all frames: detections.jsonl, and what the tracker has to say.
Result<void> FindMarkers(ReplayState& state, devices::Recording recording);

/// Takes the path of the marker that the scene stands on, and writes poses/ and the forms of the
/// path that are asked for.
Result<void> WriteTrajectories(ReplayState& state);

}  // namespace pleinair::app
