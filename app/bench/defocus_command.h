#pragma once

#include "app/commands/command.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Adds `pleinair bench defocus` and `pleinair bench motion`.
void AddDefocusBenchCommand(CLI::App& bench, CommandResult& result);

}  // namespace pleinair::app
