#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tracker/calibration/calibration_board.h"

namespace pleinair::tracker {

/// Selects views from a video: those that show the board, held still, where no earlier view has it.
class ViewPicker {
 public:
  ViewPicker(std::vector<Vec2> board_points, int width)
      : board_points_(std::move(board_points)), width_(width) {}

  /// True if this view is worth keeping; it then counts as kept.
  bool Take(const BoardView& view);
  /// Reports a frame without a board.
  void Miss() { last_.reset(); }

 private:
  using Outline = std::array<Vec2, 4>;
  /// Positions of the board's four outer corners, extrapolated if not visible.
  std::optional<Outline> OutlineOf(const BoardView& view) const;

  const std::vector<Vec2> board_points_;
  const int width_;
  std::optional<Outline> last_;
  std::vector<Outline> kept_;
};

}  // namespace pleinair::tracker
