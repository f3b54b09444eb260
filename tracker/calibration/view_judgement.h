#pragma once

#include <string>
#include <vector>

#include "tracker/calibration/lens_fit.h"
#include "tracker/calibration/lens_uncertainty.h"
#include "tracker/calibration/view_coverage.h"

namespace pleinair::tracker {

/// Fewer views than this are refused.
constexpr int kFewestViews = 4;

/// What the views are like, and what is wrong with them.
struct ViewJudgement {
  double largest_tilt_deg = 0.0;     ///< Of a board against the picture's plane.
  double widest_apart_deg = 0.0;     ///< Between the planes of two views.
  double depth_ratio = 1.0;          ///< The farthest point's depth over the nearest one's.
  double distance_ratio = 1.0;       ///< The same of the boards' middles.
  std::vector<std::string> reasons;  ///< Why they do not determine the lens; empty: they do.
  std::vector<std::string> advice;   ///< What would make them better.
};

/// Judges the views by the fit. Views of planes that are all parallel leave the focal length free
/// (Zhang 2000, §4.2), as do points that all lie at one depth; a part of the picture without points
/// leaves the distortion there free; and what remains shows in the standard deviations.
ViewJudgement JudgeViews(const LensFit& fit, const std::vector<PlaneView>& views,
                         const ViewCoverage& coverage, const LensUncertainty& uncertainty);

}  // namespace pleinair::tracker
