#pragma once

#include "app/commands/command.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Adds `pleinair bench clouds`.
void AddCloudBenchCommand(CLI::App& bench, CommandResult& result);

}  // namespace pleinair::app
