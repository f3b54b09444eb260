#pragma once

// Internal: between .cc files.

#include <Eigen/Core>
#include <array>
#include <vector>

namespace pleinair::compositor {

/// Logarithms of sun (red, green, blue) and of sky (red, green, blue) in one frame.
using LogLight = Eigen::Matrix<double, 6, 1>;
using LogLightMatrix = Eigen::Matrix<double, 6, 6>;

/// Precision of the channels about their mean, of sun and of sky.
LogLightMatrix ChannelPrior();

/// Random walk of the light from frame to frame. A step is the sum of four independent ones: of the
/// exposure, which moves sun and sky of all channels alike; of the sun, as a share of the full sun,
/// so that a faint one may fade to nothing; of the sky; and of each channel a little. Each has a
/// Student distribution, mostly small, at times large (Lange, Little & Taylor 1989, "Robust
/// statistical modeling using the t distribution", §3), so that a jump of one says nothing about
/// the others.
class LightWalk {
 public:
  /// `seconds`: times of the frames, ascending.
  explicit LightWalk(const std::vector<double>& seconds);

  /// Inverse covariance of the step from frame t to the next, for the current variances.
  const LogLightMatrix& Precision(std::size_t t) const { return steps_[t].precision; }
  /// Sets the variances to their expectation for this light (expectation maximisation).
  void Learn(const std::vector<LogLight>& light);

  /// From now on the light is steady: only the exposure changes.
  void Hold();

 private:
  /// Variances of one step's parts.
  struct Step {
    std::array<double, 4> usual{};  ///< Before anything is seen: exposure, sun, sky, channels.
    std::array<double, 3> parts{};  ///< Exposure, sun, sky.
    double channels = 0.0;
    LogLightMatrix precision;  ///< Of the sum.
  };
  static void SetPrecision(Step* step);
  /// `log_sun`: logarithm of the sun over the full sun, beside its sky, during the step.
  static void Learn(const LogLight& moved, double log_sun, Step* step);

  std::vector<Step> steps_;
  bool held_ = false;
};

/// Symmetric system of equations whose frames are coupled to their neighbours alone, factorized by
/// blocks (Cholesky).
class BlockTridiagonal {
 public:
  /// `diagonal` has one block per frame. The block between t and t + 1 is minus `walk`'s precision,
  /// whose share of the diagonal is added here.
  BlockTridiagonal(const std::vector<LogLightMatrix>& diagonal, const LightWalk& walk);

  std::vector<LogLight> Solve(std::vector<LogLight> right) const;
  /// Diagonal blocks of the inverse matrix.
  std::vector<LogLightMatrix> InverseBlocks() const;

 private:
  const LightWalk& walk_;
  std::vector<LogLightMatrix> inverse_;  // Of each block, after those before are eliminated.
};

}  // namespace pleinair::compositor
