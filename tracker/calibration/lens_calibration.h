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
  std::optional<LensKind> kind;  ///< Nothing: the one that foretells views left out best.
  int folds = 5;                 ///< Of the cross-validation.
  /// Called between steps of the work with the share done, 0…1; false ends it with an error.
  std::function<bool(double)> progress;
};

/// A view that the fit does without, and why.
struct DroppedView {
  std::string name, why;
};

/// One kind of lens that was tried.
struct TriedKind {
  LensKind kind = LensKind::kRadtan4;
  double rms_px = 0.0;             ///< Over the views it was fitted to.
  double validation_rms_px = 0.0;  ///< Over views left out.
};

struct LensCalibration {
  LensFit fit;
  LensUncertainty uncertainty;
  CrossValidation validation;
  ViewCoverage coverage;
  ViewJudgement judgement;
  std::vector<TriedKind> tried;
  std::vector<PlaneView> views;                 ///< Used, without the points left out.
  std::vector<std::vector<Vec2>> residuals_px;  ///< Seen less predicted, view by view.
  std::vector<DroppedView> dropped;
  int points_left_out = 0;  ///< Of the views used: they contradict all the others.
  double rms_px = 0.0;
};

/// Calibrates a camera from views of one board. Points that contradict the others are left out,
/// and views that are made of such. Errors (input), with every reason: views that do not determine
/// the lens (view_judgement.h), or of which no lens can be made.
Result<LensCalibration> CalibrateLens(const std::vector<PlaneView>& views, int width, int height,
                                      const LensCalibrationOptions& options = {});

}  // namespace pleinair::tracker
