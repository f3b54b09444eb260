#pragma once

#include <array>
#include <optional>
#include <span>

#include "base/camera_model.h"
#include "base/vector.h"

namespace pleinair::app {

/// Ratio of the focal length estimated from one view of a square to that of the calibration.
struct FocalRatio {
  double log_ratio = 0.0;
  double error = 0.0;  ///< Standard deviation of log_ratio.
};

/// Estimates the focal ratio from the corners of a square, in pixels and in order around it. The
/// homography H = [h1 h2 h3] maps the square to undistorted normalised coordinates. s is the ratio
/// of both focal lengths. After diag(1/s, 1/s, 1), h1 and h2 are orthogonal and equally long (Zhang
/// 2000, Eqs. 3 and 4). These are two equations, linear in 1/s². The centre is that of the
/// calibration. The error is that of corners with 0.1 px of noise. Nullopt: the corners have no
/// homography, or the view is from straight above, which shows no focal length.
std::optional<FocalRatio> FocalRatioFromSquare(const CameraModel& camera,
                                               const std::array<Vec2, 4>& corners_px);

/// The focal ratios of several views together.
struct FocalStatement {
  double ratio = 1.0;        ///< Weighted mean.
  double error = 0.0;        ///< Standard deviation of its logarithm.
  double wander = 0.0;       ///< Spread of the logarithms beyond their errors, one deviation.
  double wander_chi2 = 0.0;  ///< Chi-square of equal ratios over its degrees of freedom.
  int views = 0;             ///< With an error below a tenth.
};

/// Nullopt: fewer than three views with an error below a tenth.
std::optional<FocalStatement> CombineFocalRatios(std::span<const FocalRatio> ratios);

}  // namespace pleinair::app
