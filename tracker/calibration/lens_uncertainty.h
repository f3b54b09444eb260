#pragma once

#include <array>
#include <vector>

#include "tracker/calibration/lens_fit.h"

namespace pleinair::tracker {

/// Uncertainty of a calibrated lens.
struct LensUncertainty {
  double noise_px = 0.0;    ///< Standard deviation of one coordinate, from the residuals.
  double assumed_px = 0.0;  ///< Noise used for the deviations below: noise_px or the assumed
                            ///< minimum.
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;
  std::array<double, 8> distortion{};
  bool determined = true;  ///< False: the normal equations are singular, and the deviations are
                           ///< meaningless.
};

/// Standard deviations of the lens parameters with unknown poses. They come from the inverse of the
/// normal equations, with the poses eliminated view by view (Triggs et al. 2000, "Bundle
/// adjustment", §6.1 and §9). The factor is the variance of the residuals, at least
/// `min_noise_px`².
LensUncertainty Uncertainty(const LensFit& fit, const std::vector<PlaneView>& views,
                            double min_noise_px);

}  // namespace pleinair::tracker
