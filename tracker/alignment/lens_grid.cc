#include "tracker/alignment/lens_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pleinair::tracker {
namespace {

constexpr int kMaxNodes = 80'000;
/// Nodes outside the image on each side: markers cut by the image's edge are predicted beyond it.
constexpr int kMarginNodes = 2;
/// Rays beyond this tangent are not used for markers.
constexpr double kMaxTangent = 30.0;

}  // namespace

LensGrid::LensGrid(const CameraModel& camera) : camera_(camera), bends_(camera.HasDistortion()) {
  if (!bends_) return;
  while ((static_cast<double>(camera.width) / spacing_) * camera.height / spacing_ > kMaxNodes) {
    spacing_ *= 2;
  }
  columns_ = camera.width / spacing_ + 2 + 2 * kMarginNodes;
  rows_ = camera.height / spacing_ + 2 + 2 * kMarginNodes;
  nodes_.reserve(static_cast<std::size_t>(columns_) * rows_);
  for (int j = 0; j < rows_; ++j) {
    for (int i = 0; i < columns_; ++i) {
      const Vec2 pixel{static_cast<double>((i - kMarginNodes) * spacing_),
                       static_cast<double>((j - kMarginNodes) * spacing_)};
      const Vec2 ray = UndistortPixel(camera, pixel);
      // Beyond the fold of a lens model there is no ray; Newton's method ends at an arbitrary
      // point.
      Vec2 back;
      DistortNormalized(camera, ray.x, ray.y, &back.x, &back.y);
      const bool observed = Norm(ray) < kMaxTangent &&
                            std::fabs(back.x * camera.fx + camera.cx - pixel.x) < 1e-3 &&
                            std::fabs(back.y * camera.fy + camera.cy - pixel.y) < 1e-3;
      constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
      nodes_.push_back(observed ? UndistortedOfRay(ray) : Vec2{kNone, kNone});
    }
  }
}

Vec2 LensGrid::Undistort(double x, double y) const {
  if (!bends_) return {x, y};
  const double gx = x / spacing_ + kMarginNodes, gy = y / spacing_ + kMarginNodes;
  const int i = std::clamp(static_cast<int>(std::floor(gx)), 0, columns_ - 2);
  const int j = std::clamp(static_cast<int>(std::floor(gy)), 0, rows_ - 2);
  const double s = gx - i, t = gy - j;
  const Vec2* node = &nodes_[static_cast<std::size_t>(j) * columns_ + i];
  const Vec2 top = node[0] * (1.0 - s) + node[1] * s;
  const Vec2 bottom = node[columns_] * (1.0 - s) + node[columns_ + 1] * s;
  return top * (1.0 - t) + bottom * t;
}

void LensGrid::UndistortRow(double x0, double step, int count, double y, float* undistorted_x,
                            float* undistorted_y) const {
  if (!bends_) {
    for (int k = 0; k < count; ++k) undistorted_x[k] = static_cast<float>(x0 + step * k);
    std::fill_n(undistorted_y, count, static_cast<float>(y));
    return;
  }
  const double gy = y / spacing_ + kMarginNodes;
  const int j = std::clamp(static_cast<int>(std::floor(gy)), 0, rows_ - 2);
  const double t = gy - j, per_spacing = 1.0 / spacing_;
  const Vec2* nodes = &nodes_[static_cast<std::size_t>(j) * columns_];
  int between = -1;
  Vec2 left, by_node;
  for (int k = 0; k < count; ++k) {
    const double gx = (x0 + step * k) * per_spacing + kMarginNodes;
    const int i = gx > 0.0 ? std::min(static_cast<int>(gx), columns_ - 2) : 0;
    if (i != between) {
      between = i;
      left = nodes[i] * (1.0 - t) + nodes[i + columns_] * t;
      by_node = nodes[i + 1] * (1.0 - t) + nodes[i + 1 + columns_] * t - left;
    }
    const double s = gx - i;
    undistorted_x[k] = static_cast<float>(left.x + by_node.x * s);
    undistorted_y[k] = static_cast<float>(left.y + by_node.y * s);
  }
}

Vec2 LensGrid::PixelOfUndistorted(Vec2 undistorted) const {
  if (!bends_) return undistorted;
  const Vec2 ray = RayOfUndistorted(undistorted);
  Vec2 bent;
  DistortNormalized(camera_, ray.x, ray.y, &bent.x, &bent.y);
  return {camera_.fx * bent.x + camera_.cx, camera_.fy * bent.y + camera_.cy};
}

}  // namespace pleinair::tracker
