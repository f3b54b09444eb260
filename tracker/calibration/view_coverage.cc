#include "tracker/calibration/view_coverage.h"

#include <opencv2/imgproc.hpp>

namespace pleinair::tracker {

double ViewCoverage::Share() const {
  int observed = 0;
  for (const int count : views) observed += count > 0 ? 1 : 0;
  return observed / static_cast<double>(views.size());
}

std::array<double, 4> ViewCoverage::Halves() const {
  std::array<double, 4> halves{};
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      if (views[static_cast<std::size_t>(row * kColumns + column)] == 0) continue;
      halves[column < kColumns / 2 ? 0 : 1] += 1.0;
      halves[row < kRows / 2 ? 2 : 3] += 1.0;
    }
  }
  for (double& half : halves) half /= kColumns * kRows / 2.0;
  return halves;
}

void ViewCoverage::Add(const std::vector<Vec2>& observed_px, int width, int height) {
  std::vector<cv::Point2f> points, outline;
  for (const Vec2 observed : observed_px) {
    points.emplace_back(static_cast<float>(observed.x), static_cast<float>(observed.y));
  }
  if (points.size() < 3) return;
  cv::convexHull(points, outline);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const cv::Point2f middle(static_cast<float>((column + 0.5) * width / kColumns - 0.5),
                               static_cast<float>((row + 0.5) * height / kRows - 0.5));
      if (cv::pointPolygonTest(outline, middle, false) >= 0.0) {
        ++views[static_cast<std::size_t>(row * kColumns + column)];
      }
    }
  }
}

ViewCoverage CoverageOf(const std::vector<PlaneView>& views, int width, int height) {
  ViewCoverage coverage;
  for (const PlaneView& view : views) coverage.Add(view.observed_px, width, height);
  return coverage;
}

}  // namespace pleinair::tracker
