#pragma once

#include "base/error.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Checks that the chosen subcommand replaces only files that it may (files/output_rule.h). Outputs
/// are the values of options that name a file or folder to write. All other values count as inputs.
/// Errors (input): those of CheckNamedOutput(); two options that name one file.
Result<void> CheckOutputOptions(const CLI::App& program);

}  // namespace pleinair::app
