#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "export/print_sheets/sheet.h"
#include "tracker/calibration/calibration_board.h"

namespace pleinair::exports {

/// A chessboard or ChArUco board as it is printed: squares of `board.square_m`, the top-left one
/// black, a white margin of half a square around; a ChArUco board's markers stand in the middle of
/// its white squares, as OpenCV has laid them out since 4.6.
struct SquareBoard {
  tracker::CalibrationBoard board;
  double marker_mm = 0.0;  ///< Side of a marker's black square; ChArUco boards only.
};

/// The largest whole millimetres for the board's squares with which it fits the page. Errors
/// (input): not even the smallest does.
Result<double> MaxSquare_mm(const tracker::CalibrationBoard& board, PageSize page);

/// A page with the board, true to scale, with a dimension arrow over its first square, a ruler and
/// how to print it. Errors (input): a page that it does not fit, a dictionary that is not known.
Result<Sheet> SquareBoardSheet(const SquareBoard& board, PageSize page);

/// The board as JSON (docs/guide/calibrate.md): sides, and in metres squares, markers and corners
/// in the order and the frame of tracker::BoardPoints.
std::string DescribeBoard(const SquareBoard& board);

}  // namespace pleinair::exports
