#pragma once

#include <vector>

#include "tracker/calibration/lens_fit.h"

namespace pleinair::tracker {

/// Prediction error of a calibration on views that were not used to fit it.
struct CrossValidation {
  int folds = 0;
  double rms_px = 0.0;              ///< RMS error over held-out views, with poses fitted to them.
  std::vector<double> focal_px;     ///< Mean of fx and fy, per fold.
  std::vector<double> squares_px2;  ///< Sum of squared errors of each view, in the order of views.
};

/// Whether one model predicts views better than another beyond chance. It does if the mean
/// logarithm of the ratio of a view's squared errors exceeds two standard errors. Views that fit
/// badly thus do not outweigh the others. Both are of the same views. Source: Hastie, Tibshirani,
/// Friedman, *The Elements of Statistical Learning*, 2nd ed., 7.10, with paired ratios.
bool PredictsBetter(const CrossValidation& model, const CrossValidation& other);

/// K-fold cross-validation: fits the lens `folds` times, each time without every folds-th view, and
/// measures the held-out views. Their poses are fitted, the lens is not. There are at most as many
/// folds as views. Errors as FitLensFrom().
Result<CrossValidation> CrossValidate(const std::vector<PlaneView>& views, const LensFit& fit,
                                      int folds);

}  // namespace pleinair::tracker
