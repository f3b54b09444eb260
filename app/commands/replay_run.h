#pragma once

#include "app/commands/replay_arguments.h"
#include "base/error.h"

namespace pleinair::app {

/// Replays as the command line asks for and prints what came of it.
Result<void> RunReplay(ReplayArguments& arguments);

}  // namespace pleinair::app
