#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <memory>

#include "tracker/calibration/board_finder.h"

namespace pleinair::tracker {

std::unique_ptr<BoardFinder> CreateChessboardFinder(const CalibrationBoard& board);
std::unique_ptr<BoardFinder> CreateCharucoFinder(const CalibrationBoard& board);
std::unique_ptr<BoardFinder> CreateMarkerBoardFinder(const CalibrationBoard& board);

}  // namespace pleinair::tracker
