#include "accuracy/marker_texture.h"

#include <algorithm>
#include <cstddef>

namespace pleinair::accuracy {

MarkerTexture::MarkerTexture(const tracker::MarkerPattern& pattern)
    : modules_(pattern.modules), extent_(pattern.Extent()) {
  const int side = modules_ + 1;
  sums_.assign(static_cast<std::size_t>(side) * side, 0.0);
  for (int y = 0; y < modules_; ++y) {
    double row = 0.0;
    for (int x = 0; x < modules_; ++x) {
      row += pattern.white[y * modules_ + x];
      sums_[(y + 1) * side + x + 1] = sums_[y * side + x + 1] + row;
    }
  }
}

double MarkerTexture::Integral(double x, double y) const {
  const int column = std::min(static_cast<int>(x), modules_ - 1);
  const int row = std::min(static_cast<int>(y), modules_ - 1);
  const double u = x - column, v = y - row;
  const double* at = &sums_[static_cast<std::size_t>(row) * (modules_ + 1) + column];
  const double* below = at + modules_ + 1;
  return (1 - v) * ((1 - u) * at[0] + u * at[1]) + v * ((1 - u) * below[0] + u * below[1]);
}

double MarkerTexture::White(Vec2 at, double half_width, double half_height) const {
  constexpr double kMin = 1e-6;  // Minimum half side: a box without area has no mean.
  const auto inside = [this](double value) {
    return std::clamp(value, 0.0, static_cast<double>(modules_));
  };
  const double left = inside(at.x - std::max(half_width, kMin));
  const double right = inside(at.x + std::max(half_width, kMin));
  const double top = inside(at.y - std::max(half_height, kMin));
  const double bottom = inside(at.y + std::max(half_height, kMin));
  const double area = (right - left) * (bottom - top);
  if (!(area > 0.0)) return 1.0;
  return (Integral(right, bottom) - Integral(left, bottom) - Integral(right, top) +
          Integral(left, top)) /
         area;
}

}  // namespace pleinair::accuracy
