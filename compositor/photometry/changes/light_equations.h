#pragma once

// Internal: between .cc files.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compositor/photometry/changes/light_walk.h"
#include "compositor/photometry/changes/probe_fit.h"

namespace pleinair::compositor {

/// Unknowns that probes have in common, or a step of them.
struct LightUnknowns {
  std::vector<LogLight> light;     ///< By frame.
  std::vector<PlaneError> planes;  ///< Error of the modelled sun over sky, by plane.

  LightUnknowns(std::size_t frame_count, std::size_t plane_count)
      : light(frame_count, LogLight::Zero()), planes(plane_count, PlaneError::Zero()) {}
  double Dot(const LightUnknowns& other) const;
  void Add(const LightUnknowns& other, double factor);
  void Scale(double factor);
  /// Largest step of a frame's light.
  double Largest() const;
};

/// Equations of one Gauss-Newton step, around `now`. Albedos and errors of single probes are
/// eliminated. Unknowns are logarithms; their mean over the reference frames is 0.
class LightEquations {
 public:
  /// `probes` are linearized.
  LightEquations(const std::vector<ProbeFit>& probes, const LightWalk& walk,
                 const std::vector<std::size_t>& reference, const LightUnknowns& now);

  /// Solves by conjugate gradients (Hestenes & Stiefel 1952) until this part of the residual is
  /// left. The preconditioner is the matrix with albedos held fixed.
  LightUnknowns Solve(double end) const;
  /// Adds a sample of what the right-hand side varies by because of the priors. About unknowns of 0
  /// and with noise in the probes (ProbeFit::PutNoise()), Solve() then returns a sample of the
  /// posterior (Papandreou & Yuille 2010).
  void AddPriorNoise(std::uint32_t seed);
  /// What the probes tell of each frame with albedos held fixed: inverse covariances, without
  /// priors.
  const std::vector<LogLightMatrix>& told() const { return told_; }
  /// Covariance of each frame's light with albedos held fixed.
  std::vector<LogLightMatrix> Covariance() const;

 private:
  /// The priors' matrix times `x`: of frames, walk, planes and reference.
  LightUnknowns PriorProduct(const LightUnknowns& x) const;
  LightUnknowns Product(const LightUnknowns& x) const;

  const std::vector<ProbeFit>& probes_;
  const LightWalk& walk_;
  const std::vector<std::size_t>& reference_;
  LogLightMatrix frame_prior_, reference_prior_;
  Eigen::Matrix3d plane_prior_;
  LightUnknowns right_;
  std::vector<LogLightMatrix> told_, diagonal_;  // Diagonal blocks; with priors, too.
  std::vector<PlaneError> plane_diagonal_;
};

}  // namespace pleinair::compositor
