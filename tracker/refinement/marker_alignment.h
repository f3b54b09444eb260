#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "base/camera_model.h"
#include "base/image.h"
#include "base/vector.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// Where a marker lies, from all its pixels.
struct MarkerAlignment {
  std::array<Vec2, 4> corners_px;  ///< Top-left, then clockwise; pixels (integer = pixel centre).
  /// Covariance of the corners, x before y, corner after corner; px², row-major.
  std::array<double, 64> corner_covariance_px2{};
  double blur_px = 0.0;           ///< Standard deviation of the blur beyond the pixel's own square.
  double residual_codes = 0.0;    ///< Robust standard deviation of what is not explained, of 255.
  double visible_fraction = 1.0;  ///< Share of the marker that looks as predicted, 0…1.
};

/// Which part of a marker is observed, as far as that is known: `side`² squares of it, quiet zone
/// included, row by row from the top-left as it is read, 0 covered … 1 as predicted. Nothing known:
/// side 0.
struct VisibilityGrid {
  int side = 0;
  std::span<const float> values;
};

/// Which corners lie in the image. Those beyond it were not observed: a detector of quadrilaterals
/// may have them anywhere.
std::array<bool, 4> CornersSeen(ImageView<const std::uint8_t> grey,
                                const std::array<Vec2, 4>& corners_px);

/// Refines the corners of a marker by predicting its image: light is linear, so that a pixel holds
/// `black + (white - black) × coverage`; that is encoded with the sRGB curve and compared with the
/// image's codes, where noise and quantisation are about even. A homography of undistorted rays
/// (so that the lens bends the prediction), the blur, and fields of the black and the white level
/// that vary over the marker are fitted together, robustly, by Levenberg–Marquardt.
///
/// `corners_px` must be right to about a pixel or a quarter of a module. Nothing is returned when
/// the image does not bear the prediction out: the fit wanders off, the contrast drowns in the
/// residuals, or too little of the marker is observed.
///
/// Squares that `visibility` says are covered are left out. The robust fit alone stands up to some
/// covered pixels; from about a third of them on what they hold counts as the noise of the others.
std::optional<MarkerAlignment> AlignMarker(const CameraModel& camera, const MarkerPattern& pattern,
                                           ImageView<const std::uint8_t> grey,
                                           const std::array<Vec2, 4>& corners_px,
                                           const VisibilityGrid& visibility = {});

}  // namespace pleinair::tracker
