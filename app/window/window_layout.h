#pragma once

#include "base/vector.h"

namespace pleinair::app {

/// What lies where in a window of any size, in screen coordinates from its upper left corner.
struct WindowLayout {
  Vec2 picture;  ///< Size of the area of the picture, from the corner; the status line is below it.
  Vec2 panel_corner, panel_size;  ///< No size: there is none.

  /// The panel stands beside the picture or below it, where that is larger so; over it where both
  /// would leave next to nothing of it. `letter`: height of the letters; `picture`: pixels.
  static WindowLayout For(Vec2 window, double letter, bool panel, Vec2 picture);

  bool OnPanel(Vec2 screen) const;
};

/// Height of the status line, of the letters'.
constexpr double kStatusHeight = 1.9;

}  // namespace pleinair::app
