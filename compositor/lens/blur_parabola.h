#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "compositor/lens/focus_fit.h"
#include "compositor/lens/weighted_fit.h"

namespace pleinair::compositor {

/// Blur of a print's edge over its distance z: σ² = a + b q + c q² + e v², pixels², with q = 1/z
/// (1/m) and the speed v across the edge (px/s). docs/method/lens.md derives it.
struct BlurParabola {
  double a = 0.0, b = 0.0, c = 0.0, e = 0.0;

  double At(const BlurReading& reading) const {
    return a + b * reading.dioptres + c * reading.dioptres_squared + e * reading.squared_speed;
  }
  /// Where it is lowest, 1/m.
  double Focus() const { return -b / (2.0 * c); }
  /// Its lowest value, px².
  double Lowest() const { return a - b * b / (4.0 * c); }
};

/// Which of its terms are known.
struct ParabolaShape {
  std::optional<double> curvature, focus_dioptres;  ///< c, −b / 2c.
  std::optional<double> motion = 0.0;               ///< e; nothing: unknown.
};

/// A fitted parabola and its formal errors for weights that are inverse variances.
struct FittedParabola {
  BlurParabola parabola;
  double curvature_error = 0.0, focus_error = 0.0, motion_error = 0.0;
};

/// Fits the unknown terms; nothing where the readings do not determine them.
inline std::optional<FittedParabola> FitParabola(std::span<const BlurReading> readings,
                                                 std::span<const double> weights,
                                                 const ParabolaShape& shape) {
  // Unknowns: a, the slope b, the curvature c, the motion e. A known one is moved to the other side
  // of its equation, and an equation of its own holds its place at zero.
  const double focus = shape.focus_dioptres.value_or(0.0),
               curvature = shape.curvature.value_or(0.0);
  WeightedFit<4> fit;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!(weights[i] > 0.0)) continue;
    const BlurReading& reading = readings[i];
    const double q = reading.dioptres, q2 = reading.dioptres_squared;
    const double bowl = shape.focus_dioptres ? q2 - 2.0 * focus * q + focus * focus : q2;
    const double known = curvature * bowl + shape.motion.value_or(0.0) * reading.squared_speed;
    fit.Add({1.0, shape.focus_dioptres ? 0.0 : q, shape.curvature ? 0.0 : bowl,
             shape.motion ? 0.0 : reading.squared_speed},
            reading.blur_px * reading.blur_px - known, weights[i]);
  }
  if (shape.focus_dioptres) fit.Add({0.0, 1.0, 0.0, 0.0}, 0.0, 1.0);
  if (shape.curvature) fit.Add({0.0, 0.0, 1.0, 0.0}, 0.0, 1.0);
  if (shape.motion) fit.Add({0.0, 0.0, 0.0, 1.0}, 0.0, 1.0);
  const auto solved = fit.Solve();
  if (!solved) return std::nullopt;
  FittedParabola fitted;
  BlurParabola& p = fitted.parabola;
  p.c = shape.curvature.value_or(solved->value[2]);
  p.a = solved->value[0] + (shape.focus_dioptres ? p.c * focus * focus : 0.0);
  p.b = shape.focus_dioptres ? -2.0 * p.c * focus : solved->value[1];
  p.e = shape.motion.value_or(solved->value[3]);
  const auto& covariance = solved->covariance;
  if (!shape.curvature) fitted.curvature_error = std::sqrt(std::max(0.0, covariance[2][2]));
  if (!shape.motion) fitted.motion_error = std::sqrt(std::max(0.0, covariance[3][3]));
  if (!shape.focus_dioptres) {
    // d(−b / 2c) = −db / 2c + b dc / 2c².
    const double by_b = -1.0 / (2.0 * p.c), by_c = p.b / (2.0 * p.c * p.c);
    double variance = by_b * by_b * covariance[1][1];
    if (!shape.curvature) {
      variance += by_c * by_c * covariance[2][2] + 2.0 * by_b * by_c * covariance[1][2];
    }
    fitted.focus_error = std::sqrt(std::max(0.0, variance));
  }
  return fitted;
}

}  // namespace pleinair::compositor
