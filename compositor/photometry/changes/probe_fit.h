#pragma once

// Internal: between .cc files.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compositor/photometry/changes/light_probes.h"
#include "compositor/photometry/changes/light_walk.h"

namespace pleinair::compositor {

/// Error of the modelled sun over sky that the probes of a plane have in common, logarithms of red,
/// green and blue.
using PlaneError = Eigen::Vector3d;

/// Brightness of a probe in one frame, and its logarithm over the model.
struct ProbeReading {
  std::uint32_t frame = 0;
  std::array<float, 3> log_linear{}, residual{};
};

/// How the model divides and weighs a reading. Apart from it, since conjugate gradients run through
/// all of these in every step.
struct ReadingTerm {
  std::uint32_t frame = 0;
  std::array<float, 3> sun_share{};  ///< Share of the sun in the modelled light.
  std::array<float, 3> weight{};     ///< Inverse variance, less for outliers.
};

/// One probe over time: its readings, its albedo, and the error of its modelled sun over sky.
/// Albedo and error are eliminated from the equations of the light (Schur complement), and found
/// from its solution.
class ProbeFit {
 public:
  ProbeFit(const ProbeLight& light, std::size_t plane) : light_(light), plane_(plane) {}

  void Add(std::size_t frame, const std::array<float, 3>& linear);
  bool empty() const { return readings_.empty(); }
  std::size_t plane() const { return plane_; }
  /// True if the phantoms let most of the sun through to it.
  bool IsSunlit() const { return light_.IsSunlit(); }
  /// Share of the sun in its light, as modelled for the recording: mean of the channels.
  double SunShare() const;
  const std::vector<ProbeReading>& readings() const { return readings_; }
  double noise() const { return noise_; }

  /// Sets the albedo to what explains the readings. `factors` are the exponentials of the frames'
  /// light, here and below.
  void SetAlbedo(const std::vector<LogLight>& factors);
  /// Mean logarithm of a reading's light over the model's in the recording's own light.
  double Brightness(const ProbeReading& reading) const;

  /// Evaluates the model: shares, residuals and weights of the readings. `plane_error` is that of
  /// all probes of the plane. `independent` are factors on the weights, by frame.
  void Linearize(const std::vector<LogLight>& factors, const PlaneError& plane_error,
                 const std::vector<double>& independent);
  /// Equations of the light: adds this probe's part of the right-hand side, with the probe's own
  /// unknowns eliminated, and of the diagonal blocks, without that.
  void AddEquations(std::vector<LogLight>* right, PlaneError* plane_right,
                    std::vector<LogLightMatrix>* diagonal, PlaneError* plane_diagonal) const;
  /// Adds the product of the eliminated matrix with a step of light and plane error.
  void AddProduct(const std::vector<LogLight>& step, const PlaneError& plane_step,
                  std::vector<LogLight>* product, PlaneError* plane_product) const;
  /// Puts noise of the readings, and of the own error's prior, in the place of the residuals, so
  /// that AddEquations() adds a sample of what the equations' right-hand side varies by.
  /// Linearize() again before the next Move().
  void PutNoise(std::uint32_t seed);
  /// Moves albedo and own error for this step of the light.
  void Move(const std::vector<LogLight>& step, const PlaneError& plane_step);

  /// Sets the noise by the residuals; `usual` is that of most probes.
  void SetNoise(double usual);
  /// Negative logarithm of the readings' likelihood with that of the own error's prior. Adds what
  /// each frame's reading has of it to `by_frame`.
  double Cost(const std::vector<LogLight>& factors, const PlaneError& plane_error,
              const std::vector<double>& independent, std::vector<double>* by_frame) const;
  /// Decides whether unmodelled geometry shades the probe: if that explains its readings better.
  void DecideShade(const std::vector<LogLight>& factors, const PlaneError& plane_error);

 private:
  using Unknowns = Eigen::Vector4d;  // Albedo of three channels, and the error.

  /// Light of sun and of sky in the recording's own light.
  std::array<LinearRgb, 2> Parts(const PlaneError& plane_error) const;
  /// The readings' changes by a step of light and plane error, as seen by the own unknowns.
  Unknowns Gather(const std::vector<LogLight>& step, const PlaneError& plane_step) const;

  ProbeLight light_;
  std::size_t plane_;
  std::vector<ProbeReading> readings_;
  std::vector<ReadingTerm> terms_;  // One per reading.
  Unknowns unknowns_ = Unknowns::Zero();
  bool shaded_ = false;
  double noise_ = 0.3;                                 // Relative.
  Eigen::Matrix4d inverse_ = Eigen::Matrix4d::Zero();  // Of the own unknowns' equations.
  double prior_ = 0.0;                                 // Precision of the own error.
  Unknowns right_ = Unknowns::Zero();
};

}  // namespace pleinair::compositor
