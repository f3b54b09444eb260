#pragma once

// Internal: between .cc files.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "compositor/photometry/changes/light_changes.h"
#include "compositor/photometry/changes/light_probes.h"
#include "compositor/photometry/changes/light_walk.h"

namespace pleinair::compositor {

/// The filter of ForwardLight: estimates sun and sky of each frame from probes.
///
/// Each probe has a normal distribution of its albedo, learnt from the frames so far. It has one as
/// the phantoms light it, one in unmodelled shadow, and the odds between both. A frame's light is
/// the maximum a posteriori under these albedos and the random walk (LightWalk). Gauss-Newton steps
/// with reweighting find it. This is an iterated Kalman filter (B. M. Bell, F. W. Cathey: The
/// iterated Kalman filter update as a Gauss-Newton method, 1993). Then each albedo takes the
/// frame's reading. An albedo that was learnt under an uncertain light hands its error on to the
/// frames that it explains.
class ForwardFilter {
 public:
  /// Restarts the filter and removes all probes. `light` is that of the next frame.
  /// `log_ratio_error` is the standard deviation of its sun over sky.
  void Start(const LogLight& light, double log_ratio_error);

  /// These are as in ForwardLight.
  void AddProbe(const ProbeLight& light);
  FrameLight Add(const ProbedFrame& frame);
  bool changes() const { return changes_; }

 private:
  /// Error of log(sun over sky) that a frame's probes have in common, one standard deviation.
  struct CommonError {
    double by_chance = 0.0;  ///< By the light under which their albedos were learnt.
    /// By an error of the modelled sun over sky that all probes have in common: the signed factor
    /// on it.
    double per_share_error = 0.0;
  };
  /// A probe as the phantoms light it, or in unmodelled shade.
  struct Case {
    std::array<double, 3> sun{}, sky{};  ///< Light by the model, lux.
    std::array<double, 3> log_albedo{}, variance{};
    /// Mean share of the sun in the light under which the albedo was learnt, and that at first.
    std::array<double, 3> share{}, first_share{};
  };
  struct Probe {
    std::array<Case, 2> cases;  ///< The second one in unmodelled shade.
    bool may_be_shaded = false;
    double log_odds_shade = 0.0;
    double noise_square = 0.0;  ///< Variance of a reading, relative.
    CommonError learnt;         ///< Error of log(sun over sky) when it was first seen.
    std::uint32_t readings = 0;
  };
  struct Reading {
    std::size_t probe;
    std::array<double, 3> log_linear;
  };
  /// One case of a reading under a light.
  struct Explained {
    std::array<double, 3> share, residual, variance;
  };
  struct Equations {
    LogLightMatrix told;
    LogLight right;
    CommonError common;
    double cost;  ///< Negative logarithm of the readings' likelihood.
  };

  struct Fitted {
    LogLight light;
    Equations sum{};
    LogLightMatrix prior{};
    double cost = 0.0;  ///< Less for the more likely light.
  };

  Explained Explain(const Probe& probe, const Case& as, const Reading& reading,
                    const LogLight& factors) const;
  static double Cost(const Explained& explained, double noise_scale);
  /// Probabilities of the probe's cases, by its odds and their costs for a reading.
  static std::array<double, 2> ProbabilitiesOf(const Probe& probe,
                                               const std::array<double, 2>& costs);
  Equations AddUp(const std::vector<Reading>& readings, const LogLight& light,
                  double noise_scale) const;
  /// Lights with which a frame's fit begins: that of the frame before, and one with another sun. A
  /// further one follows from the brightness of sunlit and of shaded probes.
  std::vector<LogLight> StartsOf(const std::vector<Reading>& readings) const;
  Fitted FitFrom(const LogLight& start, const std::vector<Reading>& readings, double seconds) const;
  /// Fits the light of a frame to readings of known probes. Returns the inverse covariance by these
  /// readings alone.
  LogLightMatrix Fit(const std::vector<Reading>& readings, double seconds);
  void TestForChange(const std::vector<Reading>& readings);
  void Learn(const std::vector<Reading>& readings);
  void SetUsualNoise(const std::vector<Reading>& readings);
  void LearnFirst(const Reading& reading, Probe* probe) const;
  double LogRatioError() const;

  std::vector<Probe> probes_;
  LogLight light_ = LogLight::Zero();
  LogLightMatrix covariance_ = LogLightMatrix::Zero();
  CommonError common_;
  std::optional<std::int64_t> last_ns_;
  double usual_noise_square_ = 9e-4;  // Relative variance of a reading; at first (3 %)².
  double evidence_ = 0.0;             // Logarithm of the evidence for a change.
  bool changes_ = false;
};

}  // namespace pleinair::compositor
