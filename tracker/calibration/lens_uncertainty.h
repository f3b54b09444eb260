#pragma once

#include <array>
#include <vector>

#include "tracker/calibration/lens_fit.h"

namespace pleinair::tracker {

/// How well views determine a lens.
struct LensUncertainty {
  double noise_px = 0.0;    ///< Standard deviation of one coordinate, from the residuals.
  double assumed_px = 0.0;  ///< What the deviations below are for: that, or what was assumed.
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;
  std::array<double, 8> distortion{};
  bool determined = true;  ///< False: the equations are singular, and the numbers mean nothing.
};

/// Standard deviations of the numbers of a lens when all poses are unknown, too: from the inverse
/// of the normal equations, poses eliminated view by view (Triggs et al. 2000, "Bundle adjustment",
/// §6.1 and §9), times the residuals' variance, of which at least `min_noise_px`² is assumed.
LensUncertainty Uncertainty(const LensFit& fit, const std::vector<PlaneView>& views,
                            double min_noise_px);

}  // namespace pleinair::tracker
