#include "tracker/calibration/view_picker.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

// Relative to the image's width. A board that moves more between frames is blurred, and distorted
// by rolling shutters.
constexpr double kStill = 0.01;
constexpr double kNew = 0.06;

double Apart(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += Norm(a[i] - b[i]);
  return sum / 4.0;
}

}  // namespace

bool ViewPicker::Take(const BoardView& view) {
  const auto outline = OutlineOf(view);
  const auto before = std::exchange(last_, outline);
  if (!outline || !before || Apart(*outline, *before) > kStill * width_) return false;
  const bool known = std::any_of(kept_.begin(), kept_.end(), [&](const Outline& kept) {
    return Apart(*outline, kept) < kNew * width_;
  });
  if (known) return false;
  kept_.push_back(*outline);
  return true;
}

std::optional<ViewPicker::Outline> ViewPicker::OutlineOf(const BoardView& view) const {
  std::vector<cv::Point2d> on_board, observed;
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    const Vec2 at = board_points_[static_cast<std::size_t>(view.points[i])];
    on_board.emplace_back(at.x, at.y);
    observed.emplace_back(view.observed_px[i].x, view.observed_px[i].y);
  }
  const cv::Mat found = cv::findHomography(on_board, observed);
  if (found.empty()) return std::nullopt;
  Mat3 homography;
  for (int i = 0; i < 9; ++i) {
    homography.m[static_cast<std::size_t>(i)] = found.at<double>(i / 3, i % 3);
  }
  Vec2 least = board_points_.front(), most = least;
  for (const Vec2 point : board_points_) {
    least = {std::min(least.x, point.x), std::min(least.y, point.y)};
    most = {std::max(most.x, point.x), std::max(most.y, point.y)};
  }
  Outline outline{{{least.x, most.y}, most, {most.x, least.y}, least}};
  for (Vec2& corner : outline) corner = Apply(homography, corner);
  return outline;
}

}  // namespace pleinair::tracker
