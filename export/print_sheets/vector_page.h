#pragma once

#include <span>
#include <string>

#include "export/print_sheets/sheet.h"

namespace pleinair::exports {

/// Writes PDF 1.4 with one page per sheet, at least one. Paths and text are plain operators in
/// millimetres. Helvetica is a standard font of every reader. The file requests printing without
/// scaling, and contains no data that varies between runs or machines. Cairo (1.16) lacks this
/// viewer preference and replaces Helvetica by the machine's font, in SVG too.
std::string WritePdf(std::span<const Sheet> sheets);

/// Writes SVG 1.1 with the page's size in millimetres as its unit.
std::string WriteSvg(const Sheet& sheet);

}  // namespace pleinair::exports
