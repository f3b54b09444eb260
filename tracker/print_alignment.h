#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/camera_model.h"
#include "base/image.h"
#include "base/vector.h"
#include "tracker/print_pattern.h"

namespace pleinair::tracker {

/// Where a print lies, from all its pixels.
struct PrintAlignment {
  std::array<Vec2, 4> corners_px;  ///< Top-left, then clockwise; pixels (integer = pixel centre).
  /// Covariance of the corners, x before y, corner after corner; px², row-major.
  std::array<double, 64> corner_covariance_px2{};
  double blur_px = 0.0;           ///< Standard deviation of the blur beyond the pixel's own square.
  double residual_codes = 0.0;    ///< Robust standard deviation of what is not explained, of 255.
  double visible_fraction = 1.0;  ///< Share of the print that looks as predicted, 0…1.
};

/// Refines the corners of a print by predicting its picture: light is linear, so that a pixel holds
/// `black + (white - black) × coverage`; that is encoded with the sRGB curve and compared with the
/// picture's codes, where noise and quantisation are about even. A homography of undistorted rays
/// (so that the lens bends the prediction), the blur, and fields of the black and the white level
/// that vary over the print are fitted together, robustly, by Levenberg–Marquardt.
///
/// `corners_px` must be right to about a pixel or a quarter of a module. Nothing is returned when
/// the picture does not bear the prediction out: the fit wanders off, the contrast drowns in the
/// residuals, or too little of the print is seen.
std::optional<PrintAlignment> AlignPrint(const CameraModel& camera, const PrintPattern& pattern,
                                         ImageView<const std::uint8_t> grey,
                                         const std::array<Vec2, 4>& corners_px);

}  // namespace pleinair::tracker
