#pragma once

// Internal: between the .cc files of this module; not installed.

#include <Eigen/Dense>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "tracker/marker_pattern.h"
#include "tracker/refinement/marker_noise.h"
#include "tracker/refinement/marker_prediction.h"

namespace pleinair::tracker {

/// Fits a marker's place, blur and light to pixels, robustly, by Levenberg–Marquardt.
class MarkerFit {
 public:
  /// All are kept by reference. `contrast` is white less black in linear light, roughly.
  MarkerFit(const MarkerPattern& pattern, const std::vector<MarkerPixel>& pixels, double contrast,
            double side_px)
      : pattern_(pattern), all_pixels_(pixels), contrast_(contrast), side_px_(side_px) {}

  /// From `start` to the best state; false where the equations have no solution. What follows is
  /// meant after it returned true.
  bool Run(const MarkerFitState& start);

  const MarkerFitState& state() const { return state_; }
  /// Robust standard deviation of the residuals, codes.
  double ResidualCodes() const;
  /// Share of the pixels that look as predicted.
  double AgreeingShare() const;
  /// Covariance of the homography's motion: rays_from_marker (I + Δ), Δ's first eight entries by
  /// row, but for translation before the linear part: (Δ02 Δ00 Δ01 Δ12 Δ10 Δ11 Δ20 Δ21). Row-major.
  std::array<double, 64> MotionCovariance() const;

 private:
  struct NormalEquations {
    Eigen::MatrixXd hessian;
    Eigen::VectorXd gradient;
    double cost = 0.0;  ///< Robust, in standard deviations, priors included.
    std::vector<MarkerResidual> residuals;
  };
  /// Sums of the gradient over blocks of pixels, with the block's place.
  using BlockGradients = std::map<std::pair<int, int>, Eigen::VectorXd>;

  bool Optimize(std::vector<MarkerPixel> pixels);
  void SetNoise(const MarkerNoise& noise, const NormalEquations& equations);
  /// Of all pixels_; most of the work.
  void Predict(const MarkerFitState& state, std::vector<Predicted>* predicted) const;
  /// Of `predictions` from `state`, under variance_.
  NormalEquations EquationsOf(const std::vector<Predicted>& predictions,
                              const MarkerFitState& state, BlockGradients* blocks) const;
  void AddPriors(const MarkerFitState& state, NormalEquations* equations) const;
  static MarkerFitState Moved(const MarkerFitState& state, const Eigen::VectorXd& step);
  static double CorrelationFactor(const BlockGradients& blocks, const Eigen::MatrixXd& covariance);

  const MarkerPattern& pattern_;
  const std::vector<MarkerPixel>& all_pixels_;
  const double contrast_, side_px_;
  std::vector<MarkerPixel> pixels_;  ///< Those that are fitted now.
  std::vector<double> variance_;     ///< … and the variance that each of them has.
  MarkerFitState state_;
  std::vector<Predicted> predicted_;       ///< Of pixels_ from state_,
  std::vector<Predicted> next_predicted_;  ///< … and from the state that is tried.
  MarkerNoise noise_;
  NormalEquations fitted_;  ///< At the best state, with all pixels,
  BlockGradients blocks_;   ///< … and what blocks of pixels add to them.
};

}  // namespace pleinair::tracker
