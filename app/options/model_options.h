#pragma once

namespace CLI {
class App;
}

namespace pleinair::app {

/// Adds --allow-outside: models of the command may name files outside their own folders.
void AddModelFileOptions(CLI::App& command);

}  // namespace pleinair::app
