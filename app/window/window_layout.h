#pragma once

#include "base/vector.h"

namespace pleinair::app {

/// Layout of a window of any size, in screen coordinates from its upper left corner.
struct WindowLayout {
  Vec2 picture;  ///< Size of the image area, from the corner; the status line is below it.
  Vec2 panel_corner, panel_size;  ///< Zero size: no panel.

  /// The panel lies beside or below the image, whichever leaves the image larger. It overlaps the
  /// image if both would leave too little of it. `letter`: font height; `picture`: image size,
  /// pixels.
  static WindowLayout For(Vec2 window, double letter, bool panel, Vec2 picture);

  bool OnPanel(Vec2 screen) const;
};

/// Height of the status line, in font heights.
constexpr double kStatusHeight = 1.9;

}  // namespace pleinair::app
