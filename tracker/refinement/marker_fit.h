#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <Eigen/Dense>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "tracker/marker_pattern.h"
#include "tracker/refinement/marker_noise.h"
#include "tracker/refinement/marker_prediction.h"

namespace pleinair::tracker {

/// Robust Levenberg–Marquardt fit of a marker's homography, blur and light levels to pixels.
class MarkerFit {
 public:
  /// All arguments are kept by reference. `contrast`: approximate white minus black in linear
  /// light.
  MarkerFit(const MarkerPattern& pattern, const std::vector<MarkerPixel>& pixels, double contrast,
            double side_px)
      : pattern_(pattern), all_pixels_(pixels), contrast_(contrast), side_px_(side_px) {}

  /// Iterates from `start`; returns false if the equations are singular. The other functions are
  /// valid only after it has returned true.
  bool Run(const MarkerFitState& start);

  const MarkerFitState& state() const { return state_; }
  /// Robust standard deviation of the residuals, 8-bit values.
  double ResidualCodes() const;
  /// Share of the pixels that match the prediction.
  double AgreeingShare() const;
  /// Covariance of the homography's motion: rays_from_marker (I + Δ). Order of Δ's eight entries:
  /// (Δ02 Δ00 Δ01 Δ12 Δ10 Δ11 Δ20 Δ21), row-major 8×8.
  std::array<double, 64> MotionCovariance() const;

 private:
  struct NormalEquations {
    Eigen::MatrixXd hessian;
    Eigen::VectorXd gradient;
    double cost = 0.0;  ///< Robust, in standard deviations, priors included.
    std::vector<MarkerResidual> residuals;
  };
  /// Gradient sums per block of pixels, keyed by the block's position.
  using BlockGradients = std::map<std::pair<int, int>, Eigen::VectorXd>;

  bool Optimize(std::vector<MarkerPixel> pixels);
  void SetNoise(const MarkerNoise& noise, const NormalEquations& equations);
  /// Predicts all of pixels_; the main cost.
  void Predict(const MarkerFitState& state, std::vector<Predicted>* predicted) const;
  /// Normal equations of `predictions` from `state`, with variance_.
  NormalEquations EquationsOf(const std::vector<Predicted>& predictions,
                              const MarkerFitState& state, BlockGradients* blocks) const;
  void AddPriors(const MarkerFitState& state, NormalEquations* equations) const;
  static MarkerFitState Moved(const MarkerFitState& state, const Eigen::VectorXd& step);
  static double CorrelationFactor(const BlockGradients& blocks, const Eigen::MatrixXd& covariance);

  const MarkerPattern& pattern_;
  const std::vector<MarkerPixel>& all_pixels_;
  const double contrast_, side_px_;
  std::vector<MarkerPixel> pixels_;  ///< The pixels used by the present fit,
  std::vector<double> variance_;     ///< … and their variances.
  MarkerFitState state_;
  std::vector<Predicted> predicted_;       ///< For pixels_ at state_,
  std::vector<Predicted> next_predicted_;  ///< … and at the trial state.
  MarkerNoise noise_;
  NormalEquations fitted_;  ///< At the best state, with all pixels,
  BlockGradients blocks_;   ///< … and their contributions by block of pixels.
};

}  // namespace pleinair::tracker
