#pragma once

#include "app/replay/replay_state.h"

namespace pleinair::app {

/// Checks that the recording has the frame requested for the time-lapse, if its number of frames is
/// known. Errors (input): it has not.
Result<void> CheckFrameOfDay(const ReplayOptions& options, const devices::FrameSource& frames);

/// Returns the observation whose camera pose the time-lapse uses. Requires DrawsDay(). Errors
/// (input): the requested frame has no pose.
Result<session::Observation> ViewOfDay(const ReplayState& state);

/// Draws the requested time-lapse.
Result<void> DrawDay(ReplayState& state);

}  // namespace pleinair::app
