#include "compositor/photometry/changes/light_walk.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pleinair::compositor {
namespace {

// Standard deviations of a step's parts, logarithmic per square root of a second: exposure, sun,
// sky, each channel. Exposure is free: where nothing tells sun from sky, both follow the total
// brightness.
constexpr std::array kDrifts{0.5, 0.05, 0.03, 0.03};
// Range of the sun over the full sun, logarithmic, in which its steps are parts of the full sun.
constexpr double kFaintest = -4.0, kStrongest = 0.5;
// Degrees of freedom of the parts' distributions.
constexpr double kFreedom = 1.0;
constexpr double kMinSeconds = 1e-3;
// Standard deviation of a channel's light from the channels' mean, logarithmic.
constexpr double kChannelSpread = 0.1;

constexpr std::size_t kSun = 1;
// Variances of a part that may change at will, and of one that does not change.
constexpr double kFree = 1.0, kNone = 1e-9;

/// The direction in which each part moves the light.
std::array<LogLight, 3> Directions() {
  LogLight sun = LogLight::Zero(), sky = LogLight::Zero();
  sun.head<3>().setOnes();
  sky.tail<3>().setOnes();
  return {LogLight::Ones(), sun, sky};
}

/// Expected variance of a part of `dimensions` that moved by `square` in all, given its usual
/// variance: the scale of Student's distribution as a mixture of normal ones.
double ExpectedVariance(double square, double usual, double dimensions) {
  return usual * (kFreedom + square / usual) / (kFreedom + dimensions);
}

}  // namespace

LogLightMatrix ChannelPrior() {
  LogLightMatrix prior = LogLightMatrix::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Constant(-1.0 / 3.0);
  spread.diagonal().array() += 1.0;
  spread /= kChannelSpread * kChannelSpread;
  prior.block<3, 3>(0, 0) = spread;
  prior.block<3, 3>(3, 3) = spread;
  return prior;
}

LightWalk::LightWalk(const std::vector<double>& seconds) {
  for (std::size_t i = 0; i + 1 < seconds.size(); ++i) {
    const double lasts_s = std::max(seconds[i + 1] - seconds[i], kMinSeconds);
    Step step;
    for (std::size_t k = 0; k < kDrifts.size(); ++k) {
      step.usual[k] = kDrifts[k] * kDrifts[k] * lasts_s;
    }
    std::copy_n(step.usual.begin(), step.parts.size(), step.parts.begin());
    step.channels = step.usual[3];
    SetPrecision(&step);
    steps_.push_back(step);
  }
}

void LightWalk::SetPrecision(Step* step) {
  const std::array<LogLight, 3> directions = Directions();
  LogLightMatrix covariance = LogLightMatrix::Identity() * step->channels;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    covariance += step->parts[k] * directions[k] * directions[k].transpose();
  }
  step->precision = covariance.inverse();
}

void LightWalk::Learn(const LogLight& moved, double log_sun, Step* step) {
  const std::array<LogLight, 3> directions = Directions();
  const LogLight pull = step->precision * moved;
  // Each part's mean and variance, given the sum of all.
  LogLight rest = moved;
  std::array<double, 3> squares{};
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double variance = step->parts[k];
    const double mean = variance * directions[k].dot(pull);
    const double left =
        variance - variance * variance * directions[k].dot(step->precision * directions[k]);
    squares[k] = mean * mean + std::max(0.0, left);
    rest -= mean * directions[k];
  }
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double faint = k == kSun ? std::clamp(log_sun, kFaintest, kStrongest) : 0.0;
    step->parts[k] = ExpectedVariance(squares[k], step->usual[k] * std::exp(-2.0 * faint), 1.0);
  }
  const double left =
      6.0 * step->channels - step->channels * step->channels * step->precision.trace();
  step->channels = ExpectedVariance(rest.squaredNorm() + std::max(0.0, left), step->usual[3], 6.0);
  SetPrecision(step);
}

void LightWalk::Hold() {
  held_ = true;
  for (Step& step : steps_) {
    step.parts = {kFree, kNone, kNone};
    step.channels = kNone;
    SetPrecision(&step);
  }
}

void LightWalk::Learn(const std::vector<LogLight>& light) {
  if (held_) return;
  const auto log_sun = [&](std::size_t t) {
    return light[t].head<3>().mean() - light[t].tail<3>().mean();
  };
  for (std::size_t t = 0; t < steps_.size(); ++t) {
    Learn(light[t + 1] - light[t], (log_sun(t) + log_sun(t + 1)) / 2, &steps_[t]);
  }
}

BlockTridiagonal::BlockTridiagonal(const std::vector<LogLightMatrix>& diagonal,
                                   const LightWalk& walk)
    : walk_(walk), inverse_(diagonal.size()) {
  for (std::size_t t = 0; t < diagonal.size(); ++t) {
    LogLightMatrix block = diagonal[t];
    if (t + 1 < diagonal.size()) block += walk.Precision(t);
    if (t > 0) {
      const LogLightMatrix& before = walk.Precision(t - 1);
      block += before - before * inverse_[t - 1] * before;
    }
    inverse_[t] = block.ldlt().solve(LogLightMatrix::Identity());
  }
}

std::vector<LogLight> BlockTridiagonal::Solve(std::vector<LogLight> right) const {
  const std::size_t count = inverse_.size();
  for (std::size_t t = 1; t < count; ++t) {
    right[t] += walk_.Precision(t - 1) * (inverse_[t - 1] * right[t - 1]);
  }
  for (std::size_t t = count; t-- > 0;) {
    if (t + 1 < count) right[t] += walk_.Precision(t) * right[t + 1];
    right[t] = inverse_[t] * right[t];
  }
  return right;
}

std::vector<LogLightMatrix> BlockTridiagonal::InverseBlocks() const {
  std::vector<LogLightMatrix> blocks = inverse_;
  for (std::size_t t = blocks.size(); t-- > 1;) {
    const LogLightMatrix to_next = inverse_[t - 1] * walk_.Precision(t - 1);
    blocks[t - 1] += to_next * blocks[t] * to_next.transpose();
  }
  return blocks;
}

}  // namespace pleinair::compositor
