#pragma once

#include <filesystem>
#include <string>

#include "export/print_sheets/marker_sheet.h"

namespace pleinair::exports {

/// The narrowest gap between markers of a board: one white margin, which both neighbours share.
double MinGap_mm(double size_mm);

/// A board as JSON (docs/guide/print.md): numbers and corners in metres, in the board's own frame
/// (origin at its centre, x right, y up, z out of the print towards the viewer).
std::string DescribeBoard(const Board& board);

/// Metres without the rounding of binary fractions: to the picometre.
double RoundedMetres(double mm);

/// Whether a file describes a board, of whatever kind.
bool IsBoardDescription(const std::filesystem::path& file);

}  // namespace pleinair::exports
