#pragma once

#include <optional>
#include <string>

#include "tracker/calibration/calibration_board.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// The user's calibration board, as on the command line.
struct BoardOptions {
  std::string description;          ///< A file written by `pleinair board`.
  std::string chessboard, charuco;  ///< "9x6".
  std::string dictionary;
  std::optional<double> square_mm;
};

/// Adds --board, --chessboard, --charuco, --dictionary and --square-mm; `options` must outlive it.
void AddBoardOptions(CLI::App& command, BoardOptions& options);

/// Errors (input): no board or several, invalid sides, a file without a board description.
Result<tracker::CalibrationBoard> BoardOf(const BoardOptions& options);

/// Reads a board from a file written by `pleinair board`. Errors (input): another file or version.
Result<tracker::CalibrationBoard> ReadBoardDescription(const std::string& file);

/// Parses "9x6". Errors (input), about `option`: other text.
Result<std::pair<int, int>> ParseSides(const std::string& option, const std::string& text);

}  // namespace pleinair::app
