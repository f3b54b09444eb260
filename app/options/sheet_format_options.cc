#include "app/options/sheet_format_options.h"

#include <CLI/CLI.hpp>

namespace pleinair::app {

void AddFormatOptions(CLI::App& command, exports::FormatFlags& flags) {
  CLI::Option* pdf = command.add_flag("--pdf", flags.pdf, "Write PDF (the default)");
  CLI::Option* svg = command.add_flag("--svg", flags.svg, "Write SVG")->excludes(pdf);
  command.add_flag("--png", flags.png, "Write PNG, 12 pixels a millimetre")
      ->excludes(pdf)
      ->excludes(svg);
}

}  // namespace pleinair::app
