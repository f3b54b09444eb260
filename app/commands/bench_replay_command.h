#pragma once

#include "app/commands/command.h"

namespace pleinair::app {

/// Adds `replay` to `bench`, as the functions of command.h do to the program.
void AddBenchReplayCommand(CLI::App& bench, CommandResult& result);

}  // namespace pleinair::app
