#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "session/light_options.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Adds --response, --light, --light-cache, --sun-to-sky, --heading, --look and --hands; `options`
/// must outlive the command.
void AddLightOptions(CLI::App& command, session::LightOptions& options);

/// Adds --light-changes; `options` must outlive the command. `of`: what has one light with "hold".
void AddLightChangeOption(CLI::App& command, const std::string& of, session::LightOptions& options);

/// Adds the options for the accuracy of the light solver: --sky-division, --convergence and
/// --light-patches.
void AddSolverOptions(CLI::App& command, session::LightOptions& options);

/// Errors (input): the cache is not a folder.
Result<void> CheckLightCache(const std::filesystem::path& cache);

/// Returns the warning that the cache could not be written.
std::string CouldNotKeepLight(const std::filesystem::path& cache);

}  // namespace pleinair::app
