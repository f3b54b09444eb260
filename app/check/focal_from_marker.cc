#include "app/check/focal_from_marker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pleinair::app {
namespace {

/// 1 / s² of the square's corners in normalised coordinates; nullopt where it is not above zero.
std::optional<double> InverseSquare(const std::array<Vec2, 4>& p) {
  // The homography of the unit square (Heckbert 1989, section 2.2.3), third entry 1.
  const Vec2 d1 = p[1] - p[2], d2 = p[3] - p[2], sum = p[0] - p[1] + (p[2] - p[3]);
  const double determinant = d1.x * d2.y - d2.x * d1.y;
  if (determinant == 0.0) return std::nullopt;
  const double g = (sum.x * d2.y - d2.x * sum.y) / determinant;
  const double h = (d1.x * sum.y - sum.x * d1.y) / determinant;
  const Vec2 h1 = p[1] - p[0] + p[1] * g, h2 = p[3] - p[0] + p[3] * h;
  // Least squares of a (h1·h2) = -g h and a (h1² - h2²) = h² - g².
  const double p1 = h1.x * h2.x + h1.y * h2.y, q1 = -g * h;
  const double p2 = h1.x * h1.x + h1.y * h1.y - h2.x * h2.x - h2.y * h2.y, q2 = h * h - g * g;
  const double weight = p1 * p1 + p2 * p2;
  const double a = weight > 0.0 ? (p1 * q1 + p2 * q2) / weight : 0.0;
  if (!(a > 0.0) || !std::isfinite(a)) return std::nullopt;
  return a;
}

}  // namespace

std::optional<FocalRatio> FocalRatioFromSquare(const CameraModel& camera,
                                               const std::array<Vec2, 4>& corners_px) {
  constexpr double kCornerNoise_px = 0.1;
  constexpr double kStep_px = 0.01;
  const auto log_ratio = [&](const std::array<Vec2, 4>& pixels) -> std::optional<double> {
    std::array<Vec2, 4> normalized;
    std::transform(pixels.begin(), pixels.end(), normalized.begin(),
                   [&](Vec2 pixel) { return UndistortPixel(camera, pixel); });
    const auto inverse_square = InverseSquare(normalized);
    if (!inverse_square) return std::nullopt;
    return -0.5 * std::log(*inverse_square);
  };
  const auto at = log_ratio(corners_px);
  if (!at) return std::nullopt;
  double variance = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (double Vec2::*axis : {&Vec2::x, &Vec2::y}) {
      std::array<Vec2, 4> moved = corners_px;
      moved[i].*axis += kStep_px;
      const auto there = log_ratio(moved);
      if (!there) return std::nullopt;
      const double slope = (*there - *at) / kStep_px;
      variance += slope * slope * kCornerNoise_px * kCornerNoise_px;
    }
  }
  return FocalRatio{*at, std::sqrt(variance)};
}

std::optional<FocalStatement> CombineFocalRatios(std::span<const FocalRatio> ratios) {
  constexpr double kUsefulError = 0.1;
  constexpr int kFewestViews = 3;
  FocalStatement statement;
  double weights = 0.0, sum = 0.0;
  for (const FocalRatio& ratio : ratios) {
    if (!(ratio.error < kUsefulError)) continue;
    const double weight = 1.0 / (ratio.error * ratio.error);
    weights += weight;
    sum += weight * ratio.log_ratio;
    ++statement.views;
  }
  if (statement.views < kFewestViews) return std::nullopt;
  const double mean = sum / weights;
  double chi2 = 0.0;
  for (const FocalRatio& ratio : ratios) {
    if (!(ratio.error < kUsefulError)) continue;
    const double off = (ratio.log_ratio - mean) / ratio.error;
    chi2 += off * off;
  }
  statement.ratio = std::exp(mean);
  statement.error = std::sqrt(1.0 / weights);
  statement.wander_chi2 = chi2 / (statement.views - 1);
  // Method of moments (DerSimonian and Laird 1986), for weights that hardly differ.
  statement.wander =
      std::sqrt(std::max(0.0, statement.wander_chi2 - 1.0) * statement.views / weights);
  return statement;
}

}  // namespace pleinair::app
