#pragma once

#include <string>
#include <vector>

#include "tracker/calibration/lens_fit.h"
#include "tracker/calibration/lens_uncertainty.h"
#include "tracker/calibration/view_coverage.h"

namespace pleinair::tracker {

/// Fewer views than this are refused.
constexpr int kMinViews = 4;

/// What the views are like, and what is wrong with them.
struct ViewJudgement {
  double max_tilt_deg = 0.0;      ///< Of a board against the image's plane.
  double widest_apart_deg = 0.0;  ///< Between the planes of two views.
  /// Deviations of the focal length, relative, and of the centre, of the image's longer side, if
  /// each view as a whole were a little wrong; infinite where nothing determines them.
  double focal_deviation = 0.0, centre_deviation = 0.0;
  double depth_ratio = 1.0;          ///< The farthest point's depth over the nearest one's.
  double distance_ratio = 1.0;       ///< The same of the boards' middles.
  std::vector<std::string> reasons;  ///< Why they do not determine the lens; empty: they do.
  std::vector<std::string> advice;   ///< What would make them better.
};

/// Judges the views by the fit. Whether they determine focal length and centre is read from the
/// covariance of the solution, but not for independent noise of every corner, which many corners
/// would average out: for views that are wrong as a whole, by a board that is not quite flat or a
/// lens that is not quite the model's. A view of a plane tells eight numbers (Zhang 2000, §2.3),
/// four corners' worth, so that the deviations count for so many corners a view. What the views
/// lack is named from their geometry. A part of the image without points leaves the distortion
/// there free.
ViewJudgement JudgeViews(const LensFit& fit, const std::vector<PlaneView>& views,
                         const ViewCoverage& coverage, const LensUncertainty& uncertainty);

}  // namespace pleinair::tracker
