#pragma once

// Internal: between .cc files.

#include <Eigen/Core>
#include <vector>

namespace pleinair::compositor {

/// Logarithms of sun (red, green, blue) and of sky (red, green, blue) in one frame.
using LogLight = Eigen::Matrix<double, 6, 1>;
using LogLightMatrix = Eigen::Matrix<double, 6, 6>;

/// What one frame's probes tell of its light: a quadratic cost around `at`.
struct LightEvidence6 {
  LogLight at = LogLight::Zero();
  LogLight gradient = LogLight::Zero();  ///< Of the logarithmic likelihood at `at`.
  LogLightMatrix information = LogLightMatrix::Zero();
};

/// Light of all frames with its uncertainty.
struct SmoothedLight {
  std::vector<LogLight> light;
  std::vector<LogLightMatrix> covariance;
};

/// Random walk of the light from frame to frame. Exposure moves sun and sky of all channels alike;
/// sun and sky also move by themselves, and each channel a little. Steps have a multivariate
/// Student distribution (Lange, Little & Taylor 1989, "Robust statistical modeling using the t
/// distribution", §3): mostly small, at times large.
class LightWalk {
 public:
  /// `seconds`: times of the frames, ascending.
  explicit LightWalk(const std::vector<double>& seconds);

  /// One step of the maximum a posteriori fit: the best light for the evidence and the current
  /// scales of the steps (block-tridiagonal Cholesky). Then it sets these scales by the result.
  SmoothedLight Smooth(const std::vector<LightEvidence6>& evidence);

 private:
  std::vector<LogLightMatrix> precision_;  // Of each step between frames, at its usual scale.
  std::vector<double> weight_;             // Of each step: below 1 where the light jumps.
};

}  // namespace pleinair::compositor
