#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "export/print_sheets/sheet.h"
#include "tracker/calibration/calibration_board.h"

namespace pleinair::exports {

/// A printed chessboard or ChArUco board: squares of `board.square_m`, the top-left one black, with
/// a white margin of half a square. A ChArUco board's markers are in the middle of its white
/// squares, as in OpenCV since 4.6.
struct SquareBoard {
  tracker::CalibrationBoard board;
  double marker_mm = 0.0;  ///< Side of a marker's black square; ChArUco boards only.
};

/// Returns the max. square size in whole millimetres with which the board fits the page. Errors
/// (input): not even the minimum fits.
Result<double> MaxSquare_mm(const tracker::CalibrationBoard& board, PageSize page);

/// Returns a page with the board, true to scale. It includes a dimension arrow over the first
/// square, a ruler and printing instructions. Errors (input): the board does not fit; unknown
/// dictionary.
Result<Sheet> SquareBoardSheet(const SquareBoard& board, PageSize page);

/// Describes the board as JSON (docs/guide/calibrate.md): sides; squares, markers and corners in
/// metres. Corners have the order and frame of tracker::BoardPoints.
std::string DescribeBoard(const SquareBoard& board);

}  // namespace pleinair::exports
