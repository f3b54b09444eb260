#pragma once

#include <span>

#include "base/image.h"

namespace pleinair::app {

/// What a pixel of the truth shows.
enum class PixelClass : unsigned char {
  kUnaffected,
  kSilhouette,  ///< The edge of an object: its coverage is between 0.01 and 0.99.
  kShadow,      ///< A shadow's edge: adjacent pixels without an object differ by 0.02 and more.
  kInside,      ///< An object alone.
};

/// Root mean squares and the largest of differences in linear light, where 1 is display white.
struct AntialiasingErrors {
  double rmse = 0.0;  ///< Over all pixels of a class but kUnaffected.
  double silhouette_rmse = 0.0, shadow_rmse = 0.0, inside_rmse = 0.0;  ///< 0: no such pixel.
  double worst = 0.0;
};

/// Classifies pixels by the true image and the true coverage of the objects (8 bits, in light).
Image<unsigned char> ClassifyPixels(const RgbImage& truth, const RgbImage& coverage);

AntialiasingErrors CompareToTruth(const RgbImage& image, const RgbImage& truth,
                                  const Image<unsigned char>& classes);

/// Root mean square of the change of linear light from frame to frame, over silhouettes and
/// shadows' edges of the first frame.
double ShimmerOf(std::span<const RgbImage> frames, const Image<unsigned char>& classes);

}  // namespace pleinair::app
