#include "tracker/calibration/corner_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "base/srgb.h"
#include "tracker/calibration/saddle_fit.h"

namespace pleinair::tracker {

void RefineCorners(const cv::Mat& grey, const std::vector<float>& half_windows_px,
                   std::vector<cv::Point2f>* corners) {
  constexpr float kMin = 2.0F, kMax = 16.0F;
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-3);
  // In linear light: in sRGB values the steepest point of an edge is shifted to its dark side.
  const cv::Mat table(1, 256, CV_32F, const_cast<float*>(LinearFromSrgb8().data()));
  cv::Mat linear;
  cv::LUT(grey, table, linear);
  for (std::size_t i = 0; i < corners->size(); ++i) {
    cv::Point2f& corner = (*corners)[i];
    const auto half = static_cast<int>(std::clamp(half_windows_px[i], kMin, kMax));
    const float margin = static_cast<float>(half) + 2.0F;
    const bool inside = corner.x >= margin && corner.y >= margin &&
                        corner.x <= static_cast<float>(grey.cols) - 1.0F - margin &&
                        corner.y <= static_cast<float>(grey.rows) - 1.0F - margin;
    std::vector<cv::Point2f> one{corner};
    if (inside) cv::cornerSubPix(linear, one, {half, half}, {-1, -1}, until);
    const cv::Point2f moved = one[0] - corner;
    const float most = std::max(1.5F, 0.5F * static_cast<float>(half));
    const auto fitted = inside && std::hypot(moved.x, moved.y) <= most
                            ? FitSaddle(linear, cv::Point2d(one[0]), half)
                            : std::nullopt;
    constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
    corner = fitted ? cv::Point2f(*fitted) : cv::Point2f(kNowhere, kNowhere);
  }
}

}  // namespace pleinair::tracker
