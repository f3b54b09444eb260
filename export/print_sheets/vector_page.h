#pragma once

#include <span>
#include <string>

#include "export/print_sheets/sheet.h"

namespace pleinair::exports {

/// PDF 1.4 with one page a sheet, at least one. Paths and text are plain operators in millimetres;
/// Helvetica is one of the fonts that every reader has. The file asks viewers not to scale when
/// printing, and holds nothing that varies between runs or machines. Not by Cairo (1.16), which has
/// no such viewer preference and puts the machine's font in place of Helvetica, in SVG too.
std::string WritePdf(std::span<const Sheet> sheets);

/// SVG 1.1 with the page's size in millimetres as its unit.
std::string WriteSvg(const Sheet& sheet);

}  // namespace pleinair::exports
