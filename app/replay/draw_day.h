#pragma once

#include "app/replay/replay_state.h"

namespace pleinair::app {

/// Whether the recording has the frame that the time-lapse is to be seen from, where it is known
/// how many it has. Errors (input): it has not.
Result<void> CheckFrameOfDay(const ReplayOptions& options, const devices::FrameSource& frames);

/// The observation whose camera the time-lapse looks through. Where DrawsDay(). Errors (input): the
/// frame that is asked for has no pose.
Result<session::Observation> ViewOfDay(const ReplayState& state);

/// Draws the time-lapse that is asked for.
Result<void> DrawDay(ReplayState& state);

}  // namespace pleinair::app
