#pragma once

// Internal: between the .cc files of this module; not installed.

#include <opencv2/core.hpp>
#include <vector>

namespace pleinair::tracker {

/// Moves corners of a chessboard to where the light's saddle is, each within a window of half this
/// many pixels; those that wander off by more than half of it come back as NaN.
void RefineCorners(const cv::Mat& grey, const std::vector<float>& half_windows_px,
                   std::vector<cv::Point2f>* corners);

}  // namespace pleinair::tracker
