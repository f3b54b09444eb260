#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tracker/calibration/cross_validation.h"
#include "tracker/calibration/lens_fit.h"
#include "tracker/calibration/lens_uncertainty.h"
#include "tracker/calibration/view_coverage.h"
#include "tracker/calibration/view_judgement.h"

namespace pleinair::tracker {

struct LensCalibrationOptions {
  std::optional<LensKind> kind;  ///< Unset: the model with the smallest cross-validation error.
  int folds = 5;                 ///< Folds of the cross-validation.
  /// Called between steps of the work with the completed share, 0…1. Returning false ends the
  /// calibration with an error.
  std::function<bool(double)> progress;
};

/// A view that was excluded from the fit, with the reason.
struct DroppedView {
  std::string name, why;
};

/// A lens model that was tried.
struct TriedKind {
  LensKind kind = LensKind::kRadtan4;
  double rms_px = 0.0;             ///< Over the fitted views.
  double validation_rms_px = 0.0;  ///< Over held-out views.
};

struct LensCalibration {
  LensFit fit;
  LensUncertainty uncertainty;
  CrossValidation validation;
  ViewCoverage coverage;
  ViewJudgement judgement;
  std::vector<TriedKind> tried;
  std::vector<PlaneView> views;                 ///< The views used, without excluded points.
  std::vector<std::vector<Vec2>> residuals_px;  ///< Observed less predicted, per view.
  std::vector<DroppedView> dropped;
  int points_left_out = 0;  ///< Outlier points excluded from the used views.
  double rms_px = 0.0;
};

/// Calibrates a camera from views of one board. Excludes points that contradict the others, and
/// views that consist mostly of such points. Errors (input), each with every reason: views that do
/// not determine the lens (view_judgement.h), or views to which no lens can be fitted.
Result<LensCalibration> CalibrateLens(const std::vector<PlaneView>& views, int width, int height,
                                      const LensCalibrationOptions& options = {});

}  // namespace pleinair::tracker
