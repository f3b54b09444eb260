#pragma once

#include <filesystem>
#include <string>

#include "export/print_sheets/marker_sheet.h"

namespace pleinair::exports {

/// Min. gap between markers of a board: one white margin, shared by both neighbours.
double MinGap_mm(double size_mm);

/// Describes a board as JSON (docs/guide/print.md): numbers and corners in metres, in the board's
/// frame. The origin is at its centre, x right, y up, z out of the board towards the viewer.
std::string DescribeBoard(const Board& board);

/// Metres without the rounding of binary fractions: to the picometre.
double RoundedMetres(double mm);

/// True if a file describes a board of any kind.
bool IsBoardDescription(const std::filesystem::path& file);

}  // namespace pleinair::exports
