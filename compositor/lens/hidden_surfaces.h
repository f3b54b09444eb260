#pragma once

#include <vector>

#include "compositor/lens/pixel_surfaces.h"

namespace pleinair::compositor {

/// What a pixel hides behind its nearest surface.
struct HiddenSurface {
  int x = 0, y = 0;
  float object[4] = {};  ///< Premultiplied display-linear color, coverage.
  float change[3] = {};  ///< As PixelSurfaces::Change().
  float object_circle_px = 0.0F, real_circle_px = 0.0F;
};

/// A lens sees past the edges of surfaces that are out of focus, at what the pinhole image hides
/// behind them. It is taken from the nearest pixels that show surfaces farther by two layers and
/// more. Pixels without such a pixel within `reach_px` have none. `window`: of the image, and
/// beside it.
std::vector<HiddenSurface> HiddenSurfaces(const PixelSurfaces& surfaces, const PixelRect& window,
                                          int reach_px);

}  // namespace pleinair::compositor
