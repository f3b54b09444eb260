#pragma once

#include <optional>
#include <string>

#include "base/error.h"
#include "session/frame_lens.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Values of --defocus, --focus, --aperture-mm and --defocus-method as given; empty: not given.
struct DefocusArguments {
  std::string mode, focus, method;
  std::optional<double> aperture_mm;
};

/// Adds the four options.
void AddDefocusOptions(CLI::App& command, DefocusArguments& arguments);

/// Reads them into the options of a session. Errors (input): focus or aperture not
/// greater than zero, unknown methods, options that have no effect with --defocus off.
Result<void> ParseDefocus(const DefocusArguments& arguments, session::DefocusOptions* defocus);

/// The options as on a command line, with a space before each; empty where none was given.
std::string DefocusOptionText(const DefocusArguments& arguments);

}  // namespace pleinair::app
