#include "app/option_use.h"

#include <CLI/CLI.hpp>

namespace pleinair::app {

Result<void> RefuseUnusedOptions(const CLI::App& command, std::initializer_list<OptionUse> uses) {
  for (const OptionUse& use : uses) {
    if (use.used || command.count(use.option) == 0) continue;
    return InputError(use.option, "has no effect here: it belongs to " + use.of, "leave it out");
  }
  return {};
}

}  // namespace pleinair::app
