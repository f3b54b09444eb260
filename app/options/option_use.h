#pragma once

#include <initializer_list>
#include <string>

#include "base/error.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// An option, whether the request uses it, and which requests do.
struct OptionUse {
  std::string option;  ///< "--exposure".
  bool used = false;
  std::string of;  ///< "a PNG or a video".
};

/// Rejects unused options, so that no input is ignored silently. Errors (input): a given option is
/// not used.
Result<void> RefuseUnusedOptions(const CLI::App& command, std::initializer_list<OptionUse> uses);

/// Makes the parser reject an empty text for any option of `command`, as from an unset shell
/// variable. Call it after all options are added.
void RefuseEmptyValues(CLI::App& command);

}  // namespace pleinair::app
