#pragma once

#include "base/vector.h"

namespace pleinair {

// In pleinair, as in OpenCV, integer coordinates are pixel centres: (0,0) is the centre of the
// top-left pixel. Others (COLMAP, OpenGL, Debian's AprilTag 3.3) put (0,0) at the outer corner of
// that pixel, so that pixel centres lie at .5.

/// Converts from coordinates with pixel centres at .5 to ours.
constexpr Vec2 PixelFromCornerOrigin(Vec2 corner_origin_px) {
  return {corner_origin_px.x - 0.5, corner_origin_px.y - 0.5};
}

/// Converts from our coordinates to those with pixel centres at .5.
constexpr Vec2 CornerOriginFromPixel(Vec2 pixel_px) { return {pixel_px.x + 0.5, pixel_px.y + 0.5}; }

}  // namespace pleinair
