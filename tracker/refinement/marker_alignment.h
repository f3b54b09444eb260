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

/// Position of a marker, fitted to all its pixels.
struct MarkerAlignment {
  std::array<Vec2, 4> corners_px;  ///< Clockwise from top-left; pixels (integer = pixel centre).
  /// Covariance of the corners, x before y, corner after corner; px², row-major.
  std::array<double, 64> corner_covariance_px2{};
  double blur_px = 0.0;           ///< Standard deviation of the blur beyond the pixel's own square.
  double residual_codes = 0.0;    ///< Robust standard deviation of the residuals, in 8-bit values
                                  ///< (0…255).
  double visible_fraction = 1.0;  ///< Share of the marker that matches the prediction, 0…1.
};

/// Visibility map of a marker: `side`² squares of it, quiet zone included, row by row from the
/// top-left of the upright marker; 0 covered … 1 as predicted. Unknown: side 0.
struct VisibilityGrid {
  int side = 0;
  std::span<const float> values;
};

/// Which corners lie inside the image. Corners outside were not observed: a quadrilateral detector
/// may have extrapolated them wrongly.
std::array<bool, 4> CornersSeen(ImageView<const std::uint8_t> grey,
                                const std::array<Vec2, 4>& corners_px);

/// Refines the corners of a marker by predicting its image. In linear light a pixel is `black +
/// (white - black) × coverage`. The prediction is encoded with the sRGB curve and compared in 8-bit
/// values, where noise and quantisation are about uniform. Levenberg–Marquardt with a robust loss
/// fits a homography of undistorted rays (so that lens distortion is included), the blur, and
/// fields of the black and white levels over the marker.
///
/// `corners_px` must be accurate to about a pixel or a quarter of a module. Returns nullopt if the
/// prediction does not match: the fit diverges, the contrast is below the residuals, or too little
/// of the marker is visible.
///
/// Squares that are covered according to `visibility` are excluded. The robust fit alone tolerates
/// some covered pixels; from about a third on, their residuals are mistaken for noise.
std::optional<MarkerAlignment> AlignMarker(const CameraModel& camera, const MarkerPattern& pattern,
                                           ImageView<const std::uint8_t> grey,
                                           const std::array<Vec2, 4>& corners_px,
                                           const VisibilityGrid& visibility = {});

}  // namespace pleinair::tracker
