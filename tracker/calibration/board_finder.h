#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "base/camera_model.h"
#include "base/image.h"
#include "tracker/calibration/calibration_board.h"

namespace pleinair::tracker {

/// Detects the points of a calibration board in images of an uncalibrated camera. One thread at a
/// time.
class BoardFinder {
 public:
  /// Errors as CheckBoard().
  static Result<std::unique_ptr<BoardFinder>> Create(const CalibrationBoard& board);
  virtual ~BoardFinder() = default;

  /// The points detected in an sRGB-encoded grey image; nullopt if fewer than six.
  virtual std::optional<BoardView> Find(ImageView<const std::uint8_t> grey) = 0;

  /// Measures the points again with an approximate calibration, for boards whose straight edges the
  /// lens bends. Leaves the view unchanged for other boards.
  virtual void Refine(const CameraModel& camera, ImageView<const std::uint8_t> grey,
                      BoardView* view) {
    static_cast<void>(camera), static_cast<void>(grey), static_cast<void>(view);
  }
  virtual bool refines() const { return false; }

  /// The board, with the dictionary filled in if it was detected.
  virtual const CalibrationBoard& board() const = 0;

  /// Advice for the user when no image shows the board, for example that its size is counted
  /// differently; empty if there is none. Examines one such image.
  virtual std::string Hint(ImageView<const std::uint8_t> grey) {
    static_cast<void>(grey);
    return "";
  }
};

/// Minimum number of points in an image that is used.
constexpr int kMinPoints = 6;

}  // namespace pleinair::tracker
