#pragma once

#include <optional>
#include <string>

#include "base/error.h"
#include "compositor/antialiasing.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Values of --antialiasing and --antialiasing-samples as given.
struct AntialiasingArguments {
  std::string method;          ///< Empty: not given.
  std::optional<int> samples;  ///< Places of a pixel.
};

/// Adds --antialiasing and --antialiasing-samples.
void AddAntialiasingOptions(CLI::App& command, AntialiasingArguments& arguments);

/// Errors (input): samples for a method that has none to choose.
Result<compositor::Antialiasing> ParseAntialiasing(const AntialiasingArguments& arguments);

/// The options as on a command line, with a space before each; empty where none was given.
std::string AntialiasingOptionText(const AntialiasingArguments& arguments);

}  // namespace pleinair::app
