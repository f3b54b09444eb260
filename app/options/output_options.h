#pragma once

#include "base/error.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Applies the rule for files that a command may replace (files/output_rule.h) to all options of
/// the chosen subcommand that name a file or folder to write. All other values count as inputs.
/// Errors (input): those of the rule; two options that name one file.
Result<void> CheckOutputOptions(const CLI::App& program);

}  // namespace pleinair::app
