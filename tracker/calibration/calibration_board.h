#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// Pattern of a calibration board.
enum class BoardKind {
  kChessboard,  ///< Black and white squares.
  kCharuco,     ///< The same with a marker of OpenCV's aruco module in each white square.
  kMarkers,     ///< S-G markers side by side (`pleinair board`).
};

/// A flat calibration board with known point positions.
struct CalibrationBoard {
  BoardKind kind = BoardKind::kChessboard;
  /// Chessboards: number of inner corners, as in OpenCV. ChArUco: number of squares, as in OpenCV.
  /// Markers: number of markers.
  int columns = 0, rows = 0;
  double square_m = 0.03;  ///< Side of a square, or edge of an S-G marker.
  double gap_m = 0.0;      ///< Between S-G markers.
  int first = 0;           ///< Id of the top-left S-G marker.
  /// ChArUco: OpenCV's name without "DICT_", such as "5x5_100"; empty: detected from the images.
  std::string dictionary;

  /// "ChArUco board of 7 x 5 squares (5x5_100)".
  std::string Description() const;
};

/// Errors (input): impossible numbers of rows or columns; sizes that are not positive; an unknown
/// dictionary, or one with fewer markers than the board.
Result<void> CheckBoard(const CalibrationBoard& board);

/// Positions of the board's points in metres from its centre, x right, y up, on the upright board.
/// Order: inner corners row by row from the top-left; for S-G markers four corners each, clockwise
/// from top-left.
std::vector<Vec2> BoardPoints(const CalibrationBoard& board);

/// The points of a board that were detected in one image.
struct BoardView {
  std::string name;               ///< Name of the image.
  std::vector<int> points;        ///< Indices of the detected points, ascending.
  std::vector<Vec2> observed_px;  ///< Integer = pixel centre.
};

}  // namespace pleinair::tracker
