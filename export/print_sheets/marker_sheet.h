#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "export/print_sheets/sheet.h"

namespace pleinair::exports {

/// Printable edge lengths: modules of at least 0.1 mm, and a page that fits a PDF.
constexpr double kMinMarker_mm = 4.0;
constexpr double kMaxMarker_mm = 4000.0;

/// Errors (input): a length of the command line that is not a number, because ranges accept "nan".
Result<void> CheckLength(const std::string& option, double length_mm);

/// Corners of a marker's outer black square on its page: from top-left, clockwise.
using CornersOnPage = std::array<Vec2, 4>;

/// Returns a page with one marker true to scale and its number. It includes a dimension arrow over
/// the outer black edge, a 100 mm ruler and printing instructions. Errors (input): the marker does
/// not fit; the error names a page that does.
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

/// A page with the board, like MarkerSheet. Errors: as there.
Result<Sheet> BoardSheet(const Board& board, PageSize page);

/// Positions of a marker's corners on its page.
CornersOnPage FindCorners(const SheetMarker& print);

}  // namespace pleinair::exports
