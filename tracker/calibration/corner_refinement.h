#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <opencv2/core.hpp>
#include <vector>

namespace pleinair::tracker {

/// Refines chessboard corners to the saddle point of the intensity. Each corner has a window of
/// half this many pixels; a corner that moves by more than half of it becomes NaN.
void RefineCorners(const cv::Mat& grey, const std::vector<float>& half_windows_px,
                   std::vector<cv::Point2f>* corners);

}  // namespace pleinair::tracker
