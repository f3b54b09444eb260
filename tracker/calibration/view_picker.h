#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tracker/calibration/calibration_board.h"

namespace pleinair::tracker {

/// Picks views out of a film: those that show the board where no view before showed it, while it is
/// held still.
class ViewPicker {
 public:
  ViewPicker(std::vector<Vec2> board_points, int width)
      : board_points_(std::move(board_points)), width_(width) {}

  /// Whether this view is worth keeping; it then counts as kept.
  bool Take(const BoardView& view);
  /// A frame without a board.
  void Miss() { last_.reset(); }

 private:
  using Outline = std::array<Vec2, 4>;
  /// Where the board's four ends are or would be.
  std::optional<Outline> OutlineOf(const BoardView& view) const;

  const std::vector<Vec2> board_points_;
  const int width_;
  std::optional<Outline> last_;
  std::vector<Outline> kept_;
};

}  // namespace pleinair::tracker
