#include "tracker/alignment/motion_equations.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tracker/alignment/light_elimination.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

using Parameters = Eigen::Matrix<double, kFitParameters, 1>;
using Square = Eigen::Matrix<double, kFitParameters, kFitParameters>;

constexpr double kMinBlur_px = 0.25, kMaxBlur_px = 6.0;
/// The prediction is linear for a fraction of the side in one step, and for a pixel.
constexpr double kMaxStep = 0.06, kMaxStep_px = 1.0;

}  // namespace

SquareSides SidesOf(const Mat3& undistorted_from_unit) {
  SquareSides sides{0.0, 1e9};
  for (int i = 0; i < 4; ++i) {
    const double side = Norm(Apply(undistorted_from_unit, kSquareCorners[i]) -
                             Apply(undistorted_from_unit, kSquareCorners[(i + 1) % 4]));
    sides.mean += 0.25 * side;
    sides.shortest = std::min(sides.shortest, side);
  }
  return sides;
}

MotionEquations::MotionEquations(const FitProducts& products) : gradient(products.jr) {
  for (int a = 0, at = 0; a < kFitParameters; ++a) {
    for (int b = 0; b <= a; ++b) hessian[a * kFitParameters + b] = products.jj[at++];
  }
}

void MotionEquations::EliminateLight(const BlockMotions& sums, double gain) {
  const LightElimination eliminate(sums);
  if (!eliminate.possible) return;
  for (int a = 0; a < kFitParameters; ++a) {
    const double on_pattern = eliminate.OnPattern(sums.j[a], sums.pj[a]);
    const double on_one = eliminate.OnOne(sums.j[a], sums.pj[a]);
    gradient[a] -= gain * (on_pattern * sums.rp + on_one * sums.r);
    for (int b = 0; b <= a; ++b) {
      hessian[a * kFitParameters + b] -=
          gain * gain * (on_pattern * sums.pj[b] + on_one * sums.j[b]);
    }
  }
}

void MotionEquations::Mirror() {
  for (int a = 0; a < kFitParameters; ++a) {
    for (int b = 0; b < a; ++b) hessian[b * kFitParameters + a] = hessian[a * kFitParameters + b];
  }
}

Mat3 MotionStep::BeforeFromAfter() const {
  return Adjugate(
      {{1.0 + move[1], move[2], move[0], move[4], 1.0 + move[5], move[3], move[6], move[7], 1.0}});
}

double MotionStep::Blur(double blur_px) const {
  const double variance = blur_px * blur_px;
  const double change = std::clamp(move[kFitMotions], -0.5 * variance - 0.05, variance + 0.3);
  return std::clamp(std::sqrt(std::max(0.0, variance + change)), kMinBlur_px, kMaxBlur_px);
}

std::optional<MotionStep> SolveMotion(const MotionEquations& equations,
                                      const MotionStepOptions& options, double side_px) {
  Square hessian = Eigen::Map<const Square>(equations.hessian.data());
  Parameters gradient = Eigen::Map<const Parameters>(equations.gradient.data());
  const double size = hessian.topLeftCorner<kFitMotions, kFitMotions>().trace() / kFitMotions;
  if (!(size > 0.0)) return std::nullopt;
  hessian.diagonal().head<kFitMotions>().array() += options.damping * size;
  const auto hold = [&](int parameter) {
    hessian.row(parameter).setZero();
    hessian.col(parameter).setZero();
    hessian(parameter, parameter) = 1.0;
    gradient[parameter] = 0.0;
  };
  if (!options.fit_projection) {
    hold(6);
    hold(7);
  }
  if (!options.fit_blur) {
    hold(kFitMotions);
  } else {
    hessian(kFitMotions, kFitMotions) *= 1.05;
    hessian(kFitMotions, kFitMotions) += 1e-12;
  }
  MotionStep step;
  Eigen::Map<Parameters> move(step.move.data());
  move = hessian.ldlt().solve(gradient);
  if (!move.allFinite()) return std::nullopt;
  for (const Vec2& corner : kSquareCorners) {
    const double u = corner.x, v = corner.y;
    const double projective = move[6] * u + move[7] * v;
    step.moved_px =
        std::max(step.moved_px, std::hypot(move[0] + move[1] * u + move[2] * v - projective * u,
                                           move[3] + move[4] * u + move[5] * v - projective * v) *
                                    0.5 * side_px);
  }
  if (!std::isfinite(step.moved_px)) return std::nullopt;
  const double farthest = std::max(kMaxStep_px, kMaxStep * side_px);
  if (step.moved_px > farthest) move.head<kFitMotions>() *= farthest / step.moved_px;
  return step;
}

}  // namespace pleinair::tracker
