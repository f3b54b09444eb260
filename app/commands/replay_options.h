#pragma once

#include "app/commands/replay_arguments.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Adds the options of `replay`; `arguments` must outlive the command.
void AddReplayOptions(CLI::App& command, ReplayArguments& arguments);

}  // namespace pleinair::app
