#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "export/print_sheets/sheet.h"

namespace pleinair::exports {

/// Edges that can be printed: modules of 0.1 mm at least, and a page that a PDF can hold.
constexpr double kMinMarker_mm = 4.0;
constexpr double kMaxMarker_mm = 4000.0;

/// Errors (input): a length from the command line that is no number; ranges let "nan" pass.
Result<void> CheckLength(const std::string& option, double length_mm);

/// Corners of a marker's outer black square on its page: from top-left, clockwise.
using CornersOnPage = std::array<Vec2, 4>;

/// A page with one marker true to scale, its number, a dimension arrow over the outer black edge, a
/// 100 mm ruler and how to print it. Errors (input): a marker that does not fit, with a page that
/// would.
Result<Sheet> MarkerSheet(int number, double size_mm, PageSize page);

/// Markers with consecutive numbers on one plane, row by row from the top-left.
struct Board {
  int columns = 0, rows = 0;
  int first = 0;         ///< Number of the top-left marker.
  double size_mm = 0.0;  ///< Outer black edge of each marker.
  double gap_mm = 0.0;   ///< Between the outer black edges of neighbours.

  int Count() const { return columns * rows; }
  double Width_mm() const { return columns * size_mm + (columns - 1) * gap_mm; }
  double Height_mm() const { return rows * size_mm + (rows - 1) * gap_mm; }
  /// Centre of the i-th marker from the board's centre, x right, y up.
  Vec2 Centre_mm(int i) const;
};

/// A page with the board, like MarkerSheet. Errors as there.
Result<Sheet> BoardSheet(const Board& board, PageSize page);

/// Where the corners of a print stand on its page.
CornersOnPage FindCorners(const SheetMarker& print);

}  // namespace pleinair::exports
