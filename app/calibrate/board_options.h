#pragma once

#include <optional>
#include <string>

#include "tracker/calibration/calibration_board.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Which board a person has, as the command line says it.
struct BoardOptions {
  std::string description;          ///< A file that `pleinair board` wrote.
  std::string chessboard, charuco;  ///< "9x6".
  std::string dictionary;
  std::optional<double> square_mm;
};

/// Adds --board, --chessboard, --charuco, --dictionary and --square-mm; `options` must outlive it.
void AddBoardOptions(CLI::App& command, BoardOptions& options);

/// Errors (input): none or several boards, sides that cannot be read, a file that describes none.
Result<tracker::CalibrationBoard> BoardOf(const BoardOptions& options);

/// A board from a file that `pleinair board` wrote. Errors (input): not one, or of another version.
Result<tracker::CalibrationBoard> ReadBoardDescription(const std::string& file);

/// "9x6". Errors (input), about `option`: anything else.
Result<std::pair<int, int>> ParseSides(const std::string& option, const std::string& text);

}  // namespace pleinair::app
