#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <optional>

#include "base/vector.h"
#include "tracker/alignment/tile_kernels.h"

namespace pleinair::tracker {

/// Motion of a square with corners (±1, ±1), y down: x' = (I + M) x, M = (m1 m2 m0; m4 m5 m3; m6 m7
/// 0).
inline constexpr int kFitMotions = kFitParameters - 1;

/// Side lengths of such a square, in undistorted pixels.
struct SquareSides {
  double mean = 0.0, shortest = 0.0;
};
SquareSides SidesOf(const Mat3& undistorted_from_unit);

/// The normal equations of a Gauss–Newton fit, for eight motion parameters and the blur's variance.
struct MotionEquations {
  std::array<double, kFitParameters * kFitParameters> hessian{};
  std::array<double, kFitParameters> gradient{};

  /// Starts with the sums over pixels; fills the lower triangle of the matrix only.
  explicit MotionEquations(const FitProducts& products);
  MotionEquations() = default;
  /// Eliminates a block's gain and offset (Schur complement): J loses the part that a change of
  /// them can reproduce.
  void EliminateLight(const BlockMotions& sums, double gain);
  /// Copies the lower triangle to the upper one, as the last step.
  void Mirror();
};

struct MotionStepOptions {
  double damping;  ///< Relative to the mean diagonal element of the motions.
  bool fit_projection = true;
  bool fit_blur = false;
};

/// One step of the fit.
struct MotionStep {
  std::array<double, kFitParameters> move{};
  double moved_px = 0.0;  ///< Maximum motion of a corner, before the step was limited.

  /// unit(before)_from_unit(after), up to scale.
  Mat3 BeforeFromAfter() const;
  /// Blur after the step: a standard deviation in pixels of the window.
  double Blur(double blur_px) const;
};

/// Smaller changes of the blur count as converged; in pixels of the window.
inline constexpr double kStillBlur_px = 0.02;

/// Solves the equations. The step is limited to the range in which the prediction is linear, a
/// fraction of the side. Returns nullopt if the equations are singular. `side_px`: mean side of the
/// square in the window.
std::optional<MotionStep> SolveMotion(const MotionEquations& equations,
                                      const MotionStepOptions& options, double side_px);

}  // namespace pleinair::tracker
