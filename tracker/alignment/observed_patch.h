#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/image.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/alignment/marker_raster.h"

namespace pleinair::tracker {

/// The window of an image that a fit compares with: its values and how sure each of them is.
struct ObservedPatch {
  WindowRays rays;
  std::vector<float> value;
  std::vector<float> inverse_variance;  ///< Inverse variance up to scale; 0: not to be used.
  /// The image that TakeLinearWindow took it from, for what lies beyond the window.
  ImageView<const std::uint8_t> grey{};
};

/// Why codes are clipped: where light is beyond the camera's range they say nothing, where noise
/// takes some there, but not all of a reduced pixel's, their mean is still right enough.
enum class Clipping { kByLight, kByNoise };

/// The inverse variance that TakeLinearWindow gives to a code of so much light; 0 where it is
/// clipped.
float InverseVarianceOfLight(float linear);

/// Takes a window out of an image, in linear light; reduced pixels are means of squares of the
/// image's. Codes that are clipped by light are not to be used; the inverse variance is that of
/// even noise in codes, which is how cameras' noise looks after the sRGB curve.
void TakeLinearWindow(const LensGrid& lens, ImageView<const std::uint8_t> grey,
                      const PixelWindow& window, ObservedPatch* observed,
                      Clipping clipping = Clipping::kByLight);

/// Takes a window out of a reduced image in its codes, all alike in inverse variance: enough to
/// find a marker, not to measure it.
void TakeCodeWindow(const LensGrid& lens, ImageView<const std::uint8_t> reduced,
                    const PixelWindow& window, ObservedPatch* observed);

/// As TakeLinearWindow, but all that does not clip alike in inverse variance: a fit of too great a
/// blur, which finds a marker from farther away, then still ends where the marker is. (Weighed by
/// the noise of codes, the dark feet of edges would draw it.)
void TakeEvenWindow(const LensGrid& lens, ImageView<const std::uint8_t> grey,
                    const PixelWindow& window, ObservedPatch* observed);

/// Which pixels of an image of `width` x `height`, reduced `level` times, show the square
/// [0, side]² of a plane, and `margin` more on every side; at most the whole image. The plane is
/// told by `plane_from_undistorted`; `places` of each side are looked at, since lenses bend sides.
/// Nothing where the horizon crosses the square.
std::optional<PixelWindow> WindowOfSquare(const LensGrid& lens, const Mat3& plane_from_undistorted,
                                          double side, int places, int width, int height, int level,
                                          int margin);

}  // namespace pleinair::tracker
