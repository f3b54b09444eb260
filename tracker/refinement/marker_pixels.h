#pragma once

#include <array>
#include <vector>

#include "base/camera_model.h"
#include "base/image.h"
#include "base/vector.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// Blur with which every fit of a print starts (standard deviation beyond the pixel's own square).
inline constexpr double kInitialBlur_px = 0.6;

/// One pixel of the picture that a print covers.
struct PrintPixel {
  int x = 0, y = 0;
  Vec2 ray;      ///< Undistorted normalised coordinates.
  Vec2 ray_d_x;  ///< … and their derivative by the pixel's x,
  Vec2 ray_d_y;  ///< … and y.
  double code = 0.0;
};

struct PrintPixels {
  std::vector<PrintPixel> pixels;
  double seen_share = 1.0;  ///< Share of the print that lies inside the picture.
};

/// Whether a pixel position lies in the picture, the outermost pixels' squares included.
inline bool IsInPicture(ImageView<const std::uint8_t> grey, Vec2 pixel) {
  return pixel.x > -0.5 && pixel.y > -0.5 && pixel.x < grey.width() - 0.5 &&
         pixel.y < grey.height() - 0.5;
}

/// Pixel (integer = centre) of a point of the print (half edges, y up).
Vec2 PixelOfPrint(const CameraModel& camera, const Mat3& rays_from_print, Vec2 print);

/// The pixels that see nothing but the print, those near its edges first; where there are more than
/// a fit has use for, an even choice of them.
PrintPixels GatherPrintPixels(const CameraModel& camera, const PrintPattern& pattern,
                              ImageView<const std::uint8_t> grey, const Mat3& rays_from_print);

}  // namespace pleinair::tracker
