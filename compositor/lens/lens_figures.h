#pragma once

namespace pleinair::compositor {

/// In place of a number of places on the stop: by layers of depth (LayeredLens).
inline constexpr int kByLayers = 0;

/// What a lens has drawn.
struct LensFigures {
  /// Diameter of the largest circle of confusion, pixels, over all that virtual objects affect. 0:
  /// nothing was out of focus.
  double largest_circle_px = 0.0;
  int layers = 0;  ///< Most layers of depth in a part of the image; 0: not drawn by layers.
  int peels = 0;   ///< How often surfaces that others hide were drawn in addition.
  /// Longest streak of what the camera's motion moves during the exposure, pixels. 0: none.
  double longest_streak_px = 0.0;
  int views = 0;  ///< Views that were averaged; 0: none were.
};

}  // namespace pleinair::compositor
