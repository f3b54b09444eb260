#pragma once

#include <vector>

#include "tracker/calibration/lens_fit.h"

namespace pleinair::tracker {

/// What a lens that was fitted to some views says of others.
struct CrossValidation {
  int folds = 0;
  double rms_px = 0.0;           ///< Of views that were left out, with poses of their own.
  std::vector<double> focal_px;  ///< Mean of fx and fy, fold by fold.
};

/// Fits the lens `folds` times, each time without every folds-th view, and measures those that were
/// left out: poses are fitted to them, the lens is not. At most as many folds as there are views.
/// Errors as FitLensFrom.
Result<CrossValidation> CrossValidate(const std::vector<PlaneView>& views, const LensFit& fit,
                                      int folds);

}  // namespace pleinair::tracker
