#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "base/camera_model.h"
#include "base/image.h"
#include "tracker/calibration/calibration_board.h"

namespace pleinair::tracker {

/// Finds a board's points in pictures of a camera whose lens is not known yet. One thread at a
/// time.
class BoardFinder {
 public:
  /// Errors as CheckBoard.
  static Result<std::unique_ptr<BoardFinder>> Create(const CalibrationBoard& board);
  virtual ~BoardFinder() = default;

  /// The points observed in an sRGB-encoded grey image; nothing where fewer than six are.
  virtual std::optional<BoardView> Find(ImageView<const std::uint8_t> grey) = 0;

  /// Measures the points once more when the lens is known about, where that helps: prints whose
  /// edges the lens bends. The view stays as it is elsewhere.
  virtual void Refine(const CameraModel& camera, ImageView<const std::uint8_t> grey,
                      BoardView* view) {
    static_cast<void>(camera), static_cast<void>(grey), static_cast<void>(view);
  }
  virtual bool refines() const { return false; }

  /// The board as it turned out to be: its dictionary, where that was found by looking.
  virtual const CalibrationBoard& board() const = 0;

  /// What a person should know when no image shows the board, such as that it is counted in
  /// another way; empty where nothing is known. Looks at one such image.
  virtual std::string Hint(ImageView<const std::uint8_t> grey) {
    static_cast<void>(grey);
    return "";
  }
};

/// Fewer points than this in an image tell nothing.
constexpr int kMinPoints = 6;

}  // namespace pleinair::tracker
