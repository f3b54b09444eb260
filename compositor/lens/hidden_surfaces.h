#pragma once

#include <span>
#include <vector>

#include "compositor/lens/pinhole_image.h"
#include "compositor/lens/pixel_surfaces.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/surfaces/image_tiles.h"

namespace pleinair::compositor {

/// A pixel whose nearest surface hides others: a lens sees past the edges of surfaces that are out
/// of focus.
struct HidingPixel {
  int x = 0, y = 0;
  int layer = 0;           ///< LayerOf() the nearest surface.
  float part = 0.0F;       ///< The part of the pixel that it covers.
  bool is_object = false;  ///< It belongs to an object, else it is real.
};

/// The pixels of a window of the image, and beside it, that may hide what is seen. They lie within
/// `reach_px` of a pixel that shows surfaces farther by two layers and more.
std::vector<HidingPixel> HidingPixels(const PixelSurfaces& surfaces, const PixelRect& window,
                                      int reach_px);

/// What a pixel hides behind its nearest surface.
struct HiddenSurface {
  int x = 0, y = 0;
  float object[4] = {};  ///< Premultiplied display-linear color, coverage.
  float change[3] = {};  ///< As PixelSurfaces::Change().
  float object_circle_px = 0.0F, real_circle_px = 0.0F;
};

/// 1/z of the nearest surfaces that a surface of this layer may hide, 1/m: those farther by two
/// layers.
float BehindLayer_dioptres(const ThinLens& lens, double fx, int layer);

/// What `hidden` shows behind an object's pixel. `fx`: render pixels.
HiddenSurface BehindObject(const HiddenImage& hidden, const ThinLens& lens, double fx,
                           const HidingPixel& pixel);

/// The changes of light behind the real surfaces among `pixels`, which the frame does not show.
/// They are those of the nearest pixels that show farther ones. Objects there are known from
/// PinholeImage::objects_alone.
std::vector<HiddenSurface> BehindRealSurfaces(const PixelSurfaces& surfaces,
                                              const PixelRect& window,
                                              std::span<const HidingPixel> pixels);

}  // namespace pleinair::compositor
