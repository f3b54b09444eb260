#pragma once

#include "app/commands/replay_arguments.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Adds the options of `bench replay` that `replay` lacks: shadow maps, accuracy of the light
/// solver, shaders. `arguments` must outlive the command.
void AddResearchOptions(CLI::App& command, ReplayArguments& arguments);

/// Makes the parser of `command` reject each of them and suggest `bench replay`.
void RefuseResearchOptions(CLI::App& command);

}  // namespace pleinair::app
