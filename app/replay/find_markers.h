#pragma once

#include "app/replay/replay_state.h"

namespace pleinair::app {

/// Detects the markers of all frames: writes detections.jsonl and collects the tracker's warnings.
Result<void> FindMarkers(ReplayState& state, devices::Recording recording);

/// Selects the trajectory of the scene's reference marker. Writes poses/ and the requested
/// trajectory formats.
Result<void> WriteTrajectories(ReplayState& state);

}  // namespace pleinair::app
