#pragma once

#include <string>

#include "base/error.h"
#include "scene/trajectory_description.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Adds --trajectory and the options that describe it; `trajectory` must outlive the command.
void AddTrajectoryOptions(CLI::App& command, scene::TrajectoryDescription& trajectory);

/// Returns the options as text of a command line, with a space before each; empty without any.
/// `quoted` quotes a file's name for the shell.
std::string TrajectoryOptionText(const scene::TrajectoryDescription& trajectory,
                                 std::string (*quoted)(const std::string&));

}  // namespace pleinair::app
