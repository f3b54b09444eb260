#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/image.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/alignment/marker_raster.h"

namespace pleinair::tracker {

/// The observed image patch that a fit compares with: values and their inverse variances.
struct ObservedPatch {
  WindowRays rays;
  std::vector<float> value;
  std::vector<float> inverse_variance;  ///< Up to a common scale; 0: not used.
  /// The source image of TakeLinearWindow(), for what lies outside the window.
  ImageView<const std::uint8_t> grey{};
};

/// Cause of clipped pixel values. Where the light exceeds the camera's range, clipped values have
/// no information. Where noise clips some values of a reduced pixel but not all, their mean is
/// still accurate enough.
enum class Clipping { kByLight, kByNoise };

/// Inverse variance that TakeLinearWindow() assigns to a pixel value of this linear light; 0 where
/// it is clipped.
float InverseVarianceOfLight(float linear);

/// Copies a window of an image in linear light; reduced pixels are means of squares of image
/// pixels. Pixels clipped by light get weight 0. The inverse variance assumes noise that is
/// constant in 8-bit values, which is how cameras' noise appears after the sRGB curve.
void TakeLinearWindow(const LensGrid& lens, ImageView<const std::uint8_t> grey,
                      const PixelWindow& window, ObservedPatch* observed,
                      Clipping clipping = Clipping::kByLight);

/// Copies a window of a reduced image in 8-bit values, all with the same inverse variance: enough
/// to find a marker, not to measure it.
void TakeCodeWindow(const LensGrid& lens, ImageView<const std::uint8_t> reduced,
                    const PixelWindow& window, ObservedPatch* observed);

/// As TakeLinearWindow(), but all unclipped pixels have the same inverse variance. A fit with too
/// large a blur, which finds a marker from farther away, then still converges to the right
/// position. (With weights from the noise of 8-bit values, the dark feet of edges would attract
/// it.)
void TakeEvenWindow(const LensGrid& lens, ImageView<const std::uint8_t> grey,
                    const PixelWindow& window, ObservedPatch* observed);

/// The pixels of an image of `width` x `height`, reduced `level` times, that show the square [0,
/// side]² of a plane. `plane_from_undistorted` defines the plane. The window has `margin` more
/// pixels on every side and is clipped to the image. `places` points of each side are projected,
/// because lenses bend the sides. Returns nullopt if the horizon crosses the square.
std::optional<PixelWindow> WindowOfSquare(const LensGrid& lens, const Mat3& plane_from_undistorted,
                                          double side, int places, int width, int height, int level,
                                          int margin);

}  // namespace pleinair::tracker
