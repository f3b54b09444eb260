#pragma once

#include "app/commands/replay_arguments.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Adds the options that `bench replay` has beside those of `replay`: shadow maps, the light
/// solver's fineness, shaders. `arguments` must outlive the command.
void AddResearchOptions(CLI::App& command, ReplayArguments& arguments);

/// Makes the parser of `command` refuse each of them and name `bench replay`.
void RefuseResearchOptions(CLI::App& command);

}  // namespace pleinair::app
