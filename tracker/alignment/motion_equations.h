#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <optional>

#include "base/vector.h"
#include "tracker/alignment/tile_kernels.h"

namespace pleinair::tracker {

/// The motions of a square with corners (±1, ±1), y down, moved by x' = (I + M) x with
/// M = (m1 m2 m0; m4 m5 m3; m6 m7 0).
inline constexpr int kFitMotions = kFitParameters - 1;

/// Lengths of such a square's sides, in undistorted pixels.
struct SquareSides {
  double mean = 0.0, shortest = 0.0;
};
SquareSides SidesOf(const Mat3& undistorted_from_unit);

/// The normal equations of a fit by Gauss–Newton: of eight motions and of the blur's variance.
struct MotionEquations {
  std::array<double, kFitParameters * kFitParameters> hessian{};
  std::array<double, kFitParameters> gradient{};

  /// Begins with what pixels add up to. Of the matrix only the lower triangle is filled in …
  explicit MotionEquations(const FitProducts& products);
  MotionEquations() = default;
  /// … from which a block's gain and offset are eliminated (Schur's complement): J loses what a
  /// change of them could do as well …
  void EliminateLight(const BlockMotions& sums, double gain);
  /// … and in the end it is mirrored.
  void Mirror();
};

struct MotionStepOptions {
  double damping;  ///< Of the motions' mean diagonal.
  bool fit_projection = true;
  bool fit_blur = false;
};

/// A step of the fit.
struct MotionStep {
  std::array<double, kFitParameters> move{};
  double moved_px = 0.0;  ///< How far the farthest corner would go, before the step was limited.

  /// unit(before)_from_unit(after), to a factor.
  Mat3 BeforeFromAfter() const;
  /// The blur after the step, a standard deviation in the window's pixels.
  double Blur(double blur_px) const;
};

/// Changes of the blur by less are none, in the window's pixels.
inline constexpr double kStillBlur_px = 0.02;

/// Solves the equations. The step goes no farther than the prediction is good for, a fraction of
/// the side; nothing where there is no solution. `side_px`: the square's mean side in the window.
std::optional<MotionStep> SolveMotion(const MotionEquations& equations,
                                      const MotionStepOptions& options, double side_px);

}  // namespace pleinair::tracker
