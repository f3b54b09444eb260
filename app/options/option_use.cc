#include "app/options/option_use.h"

#include <string>

#include <CLI/CLI.hpp>

namespace pleinair::app {

Result<void> RefuseUnusedOptions(const CLI::App& command, std::initializer_list<OptionUse> uses) {
  for (const OptionUse& use : uses) {
    if (use.used || command.count(use.option) == 0) continue;
    return InputError(use.option, "has no effect here: it belongs to " + use.of, "leave it out");
  }
  return {};
}

void RefuseEmptyValues(CLI::App& command) {
  const CLI::Validator not_empty(
      [](std::string& value) {
        return std::string(value.empty() ? "is given without a value" : "");
      },
      "");
  for (CLI::Option* option : command.get_options(
           [](const CLI::Option* candidate) { return candidate->get_items_expected_max() > 0; })) {
    option->check(not_empty);
  }
}

}  // namespace pleinair::app
