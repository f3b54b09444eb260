#pragma once

// Internal: between the .cc files of this module; not installed.

#include <opencv2/core.hpp>
#include <optional>

namespace pleinair::tracker {

/// Where two blurred straight edges cross in a window of linear light, as the corner of four
/// squares of a chessboard does: level + contrast × erf(d1 / √2σ) × erf(d2 / √2σ), d1 and d2 being
/// the distances from the two edges. Place, both directions, blur, level and contrast are fitted by
/// Levenberg and Marquardt's method to every pixel within `half` of the start, so that noise
/// averages out along the edges. Nothing where the fit wanders off or explains less than nine
/// tenths of the window's variance: something lies on the corner.
std::optional<cv::Point2d> FitSaddle(const cv::Mat& linear, cv::Point2d start, int half);

}  // namespace pleinair::tracker
