#pragma once

#include "app/commands/replay_arguments.h"
#include "base/error.h"

namespace pleinair::app {

/// Runs the requested replay and prints its result.
Result<void> RunReplay(ReplayArguments& arguments);

}  // namespace pleinair::app
