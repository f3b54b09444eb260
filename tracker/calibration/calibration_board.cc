#include "tracker/calibration/calibration_board.h"

#include <cmath>

#include "tracker/calibration/aruco_dictionaries.h"
#include "tracker/golay/golay_code.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

constexpr int kMaxSide = 200;  // Cameras do not resolve finer boards.

std::string Sides(const CalibrationBoard& board) {
  return std::to_string(board.columns) + "x" + std::to_string(board.rows);
}

}  // namespace

std::string CalibrationBoard::Description() const {
  switch (kind) {
    case BoardKind::kChessboard:
      return "chessboard with " + Sides(*this) + " inner corners";
    case BoardKind::kCharuco:
      return "ChArUco board of " + Sides(*this) + " squares" +
             (dictionary.empty() ? "" : " (" + dictionary + ")");
    case BoardKind::kMarkers:
      return "board of " + Sides(*this) + " S-G markers from number " + std::to_string(first);
  }
  return "";
}

Result<void> CheckBoard(const CalibrationBoard& board) {
  const bool chessboard = board.kind == BoardKind::kChessboard;
  const int fewest = board.kind == BoardKind::kMarkers ? 1 : chessboard ? 2 : 3;
  if (board.columns < fewest || board.rows < fewest || board.columns > kMaxSide ||
      board.rows > kMaxSide || (chessboard && board.columns * board.rows < 6)) {
    return InputError("board", "a " + board.Description() + " cannot be used",
                      "count again: COLUMNSxROWS, each at most " + std::to_string(kMaxSide));
  }
  if (!(board.square_m > 0.0) || !std::isfinite(board.square_m) || !(board.gap_m >= 0.0) ||
      !std::isfinite(board.gap_m)) {
    return InputError("board", "has a size that is not greater than zero",
                      "give it in millimetres");
  }
  if (board.kind == BoardKind::kMarkers &&
      (board.first < 0 || board.first + board.columns * board.rows > kGolayNumbers)) {
    return InputError("board", "has markers beyond the last number, 4095", "see its board.json");
  }
  if (board.kind == BoardKind::kCharuco && !board.dictionary.empty()) {
    return CheckDictionary(board.dictionary, board.columns * board.rows / 2);
  }
  return {};
}

std::vector<Vec2> BoardPoints(const CalibrationBoard& board) {
  std::vector<Vec2> points;
  if (board.kind == BoardKind::kMarkers) {
    const double step = board.square_m + board.gap_m;
    for (int i = 0; i < board.columns * board.rows; ++i) {
      const Vec2 centre = Vec2{i % board.columns - 0.5 * (board.columns - 1),
                               0.5 * (board.rows - 1) - i / board.columns} *
                          step;
      for (const Vec2 corner : kSquareCorners)
        points.push_back(centre + corner * (0.5 * board.square_m));
    }
    return points;
  }
  const int inner = board.kind == BoardKind::kCharuco ? 1 : 0;
  const int columns = board.columns - inner, rows = board.rows - inner;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      points.push_back(Vec2{column - 0.5 * (columns - 1), 0.5 * (rows - 1) - row} * board.square_m);
    }
  }
  return points;
}

}  // namespace pleinair::tracker
