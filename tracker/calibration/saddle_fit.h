#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <opencv2/core.hpp>
#include <optional>

namespace pleinair::tracker {

/// Fits the crossing of two blurred straight edges to a window of linear light, the model of a
/// chessboard corner:
///
///   level + contrast × erf(d1 / √2σ) × erf(d2 / √2σ),   d1, d2 the distances from the two edges.
///
/// Levenberg–Marquardt fits position, both directions, blur σ, level and contrast to every pixel
/// within `half` of the start. Noise thus averages out along the edges. Returns nullopt if the fit
/// diverges or explains less than 0.9 of the window's variance: the corner is then occluded.
std::optional<cv::Point2d> FitSaddle(const cv::Mat& linear, cv::Point2d start, int half);

}  // namespace pleinair::tracker
