#include "tracker/calibration/board_finder.h"

#include "tracker/calibration/board_finders.h"

namespace pleinair::tracker {

Result<std::unique_ptr<BoardFinder>> BoardFinder::Create(const CalibrationBoard& board) {
  PLEINAIR_RETURN_IF_ERROR(CheckBoard(board));
  switch (board.kind) {
    case BoardKind::kChessboard:
      return CreateChessboardFinder(board);
    case BoardKind::kCharuco:
      return CreateCharucoFinder(board);
    case BoardKind::kMarkers:
      break;
  }
  return CreateMarkerBoardFinder(board);
}

}  // namespace pleinair::tracker
