#pragma once

#include <array>
#include <vector>

#include "base/camera_model.h"
#include "base/image.h"
#include "base/vector.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// Initial blur of every fit of a marker (standard deviation beyond the pixel's own square).
inline constexpr double kInitialBlur_px = 0.6;

/// An image pixel on a marker.
struct MarkerPixel {
  int x = 0, y = 0;
  Vec2 ray;      ///< Undistorted normalised coordinates.
  Vec2 ray_d_x;  ///< … and its derivative by the pixel's x,
  Vec2 ray_d_y;  ///< … and y.
  double code = 0.0;
};

struct MarkerPixels {
  std::vector<MarkerPixel> pixels;
  double observed_share = 1.0;  ///< Share of the marker that lies inside the image.
};

/// True if a pixel position lies in the image, the full squares of the outermost pixels included.
inline bool IsInImage(ImageView<const std::uint8_t> grey, Vec2 pixel) {
  return pixel.x > -0.5 && pixel.y > -0.5 && pixel.x < grey.width() - 0.5 &&
         pixel.y < grey.height() - 0.5;
}

/// Pixel (integer = centre) of a point of the marker (half edges, y up).
Vec2 PixelOfMarkerPoint(const CameraModel& camera, const Mat3& rays_from_marker, Vec2 marker);

/// The pixels that show nothing but the marker, those near its edges first. If there are more than
/// a fit needs, a uniform selection of them.
MarkerPixels GatherMarkerPixels(const CameraModel& camera, const MarkerPattern& pattern,
                                ImageView<const std::uint8_t> grey, const Mat3& rays_from_marker);

}  // namespace pleinair::tracker
