#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"
#include "export/print_sheets/sheet.h"

namespace pleinair::exports {

enum class SheetFormat { kPdf, kSvg, kPng };

/// "pdf", "svg", "png".
std::string_view FormatName(SheetFormat format);

/// Format options of the command line: at most one is set.
struct FormatFlags {
  bool pdf = false, svg = false, png = false;
};

/// Selects the flag's format, else that of the extension of `output`, else PDF. Errors (input): an
/// extension that contradicts the flag, or is none of the three.
Result<SheetFormat> ChooseFormat(const FormatFlags& flags, const std::filesystem::path& output);

/// Returns the bytes of a file with one sheet. Errors: a page too large for an image (input), no
/// memory.
Result<std::string> RenderSheet(const Sheet& sheet, SheetFormat format);

}  // namespace pleinair::exports
