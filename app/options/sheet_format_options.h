#pragma once

#include "export/print_sheets/sheet_file.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Adds the exclusive options --pdf, --svg and --png to a subcommand; `flags` must outlive it.
void AddFormatOptions(CLI::App& command, exports::FormatFlags& flags);

}  // namespace pleinair::app
