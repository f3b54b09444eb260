#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// What a calibration board shows.
enum class BoardKind {
  kChessboard,  ///< Black and white squares.
  kCharuco,     ///< The same with a marker of OpenCV's aruco module in each white square.
  kMarkers,     ///< S-G markers side by side (`pleinair board`).
};

/// A flat board whose points have known places.
struct CalibrationBoard {
  BoardKind kind = BoardKind::kChessboard;
  /// Chessboards: inner corners, as OpenCV counts them. ChArUco: squares, as OpenCV counts them.
  /// Markers: markers.
  int columns = 0, rows = 0;
  double square_m = 0.03;  ///< Side of a square, or edge of an S-G marker.
  double gap_m = 0.0;      ///< Between S-G markers.
  int first = 0;           ///< Number of the top-left S-G marker.
  /// ChArUco: as OpenCV names it without "DICT_", such as "5x5_100"; empty: found by looking.
  std::string dictionary;

  /// "ChArUco board of 7 x 5 squares (5x5_100)".
  std::string Description() const;
};

/// Errors (input): sides that no board has, sizes that are not positive, an unknown dictionary or
/// one with fewer markers than the board.
Result<void> CheckBoard(const CalibrationBoard& board);

/// Where the board's points lie, in metres from its centre, x right, y up, as it is read. In the
/// order of their numbers: inner corners row by row from the top-left; of S-G markers four corners
/// each, from top-left clockwise.
std::vector<Vec2> BoardPoints(const CalibrationBoard& board);

/// A board in one image: which of its points are observed where.
struct BoardView {
  std::string name;               ///< Of the image.
  std::vector<int> points;        ///< Their numbers, ascending.
  std::vector<Vec2> observed_px;  ///< Integer = pixel centre.
};

}  // namespace pleinair::tracker
