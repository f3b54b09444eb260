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

/// What the command line said about the format: at most one of these is set.
struct FormatFlags {
  bool pdf = false, svg = false, png = false;
};

/// The flag's format, else that of the ending of `output`, else PDF. Errors (input): an ending that
/// says otherwise than the flag, or that is none of the three.
Result<SheetFormat> ChooseFormat(const FormatFlags& flags, const std::filesystem::path& output);

/// The bytes of a file with one sheet. Errors: a page too large for a picture (input), no memory.
Result<std::string> RenderSheet(const Sheet& sheet, SheetFormat format);

/// Writes a file under a temporary name and renames it; a device or pipe that stands there is
/// written to as it is. Errors as WriteError.
Result<void> WriteSheetFile(const std::filesystem::path& path, std::string_view content);

}  // namespace pleinair::exports
