#pragma once

#include <string>
#include <vector>

#include "tracker/calibration/lens_fit.h"
#include "tracker/calibration/lens_uncertainty.h"
#include "tracker/calibration/view_coverage.h"

namespace pleinair::tracker {

/// Fewer views than this are rejected.
constexpr int kMinViews = 4;

/// Geometry of the views, and their deficiencies.
struct ViewJudgement {
  double max_tilt_deg = 0.0;      ///< Between board and image plane.
  double widest_apart_deg = 0.0;  ///< Largest angle between the planes of two views.
  /// Standard deviations for errors of whole views; infinite if undetermined. The focal length's is
  /// relative to itself, the principal point's to the image's longer side.
  double focal_deviation = 0.0, centre_deviation = 0.0;
  double depth_ratio = 1.0;          ///< Maximum depth over minimum depth of the points.
  double distance_ratio = 1.0;       ///< The same ratio for the boards' centres.
  std::vector<std::string> reasons;  ///< Why the views do not determine the lens; empty: they do.
  std::vector<std::string> advice;   ///< Suggestions for better views.
};

/// Assesses the views from the fit. The covariance of the solution shows whether they determine
/// focal length and principal point. It assumes errors of whole views: a board that is not quite
/// flat, or a lens model that does not quite match. Independent noise per corner would average out
/// over many corners. A view of a plane gives eight constraints (Zhang 2000, §2.3), those of four
/// corners, so the deviations assume four independent corners per view. The geometry of the views
/// determines the advice. Where the image has no points, the distortion is not constrained.
ViewJudgement JudgeViews(const LensFit& fit, const std::vector<PlaneView>& views,
                         const ViewCoverage& coverage, const LensUncertainty& uncertainty);

}  // namespace pleinair::tracker
