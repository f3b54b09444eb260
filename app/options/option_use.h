#pragma once

#include <initializer_list>
#include <string>

#include "base/error.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// An option, whether what is asked for makes any use of it, and what does.
struct OptionUse {
  std::string option;  ///< "--exposure".
  bool used = false;
  std::string of;  ///< "a PNG or a video".
};

/// Nothing that a person wrote is passed over in silence. Errors (input): an option was given that
/// is not used.
Result<void> RefuseUnusedOptions(const CLI::App& command, std::initializer_list<OptionUse> uses);

/// No option of `command` takes an empty text, as an unset variable of a shell gives it: the parser
/// then refuses it. Call it when all options are there.
void RefuseEmptyValues(CLI::App& command);

}  // namespace pleinair::app
