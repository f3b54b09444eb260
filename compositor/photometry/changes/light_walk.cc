#include "compositor/photometry/changes/light_walk.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cstddef>

namespace pleinair::compositor {
namespace {

// Scales of a step, logarithm per square root of a second. Exposure is free: where nothing tells
// sun from sky, both follow the total brightness.
constexpr double kExposureDrift = 0.5, kSunDrift = 0.05, kSkyDrift = 0.03, kChannelDrift = 0.01;
// Degrees of freedom of the steps' distribution.
constexpr double kFreedom = 1.0;
constexpr double kMinSeconds = 1e-3;
// Precision with which the light is that of the reference frames where nothing is seen.
constexpr double kAnchor = 1e-4;

LogLightMatrix StepPrecision(double seconds) {
  LogLight sun = LogLight::Zero(), sky = LogLight::Zero();
  sun.head<3>().setOnes();
  sky.tail<3>().setOnes();
  const LogLight all = LogLight::Ones();
  LogLightMatrix covariance = LogLightMatrix::Identity() * (kChannelDrift * kChannelDrift);
  covariance += kExposureDrift * kExposureDrift * all * all.transpose();
  covariance += kSunDrift * kSunDrift * sun * sun.transpose();
  covariance += kSkyDrift * kSkyDrift * sky * sky.transpose();
  return (covariance * std::max(seconds, kMinSeconds)).inverse();
}

}  // namespace

LightWalk::LightWalk(const std::vector<double>& seconds) {
  for (std::size_t i = 0; i + 1 < seconds.size(); ++i) {
    precision_.push_back(StepPrecision(seconds[i + 1] - seconds[i]));
  }
  weight_.assign(precision_.size(), 1.0);
}

SmoothedLight LightWalk::Smooth(const std::vector<LightEvidence6>& evidence) {
  const std::size_t count = evidence.size();
  SmoothedLight smoothed;
  smoothed.light.resize(count);
  smoothed.covariance.resize(count);
  if (count == 0) return smoothed;
  const auto step = [&](std::size_t i) { return LogLightMatrix(weight_[i] * precision_[i]); };
  // Forward: eliminate each frame into the next one.
  std::vector<LogLightMatrix> inverse(count);
  std::vector<LogLight> right(count);
  for (std::size_t t = 0; t < count; ++t) {
    const LightEvidence6& seen = evidence[t];
    LogLightMatrix diagonal =
        seen.information + LogLightMatrix(LogLightMatrix::Identity() * kAnchor);
    right[t] = seen.information * seen.at + seen.gradient;
    if (t + 1 < count) diagonal += step(t);
    if (t > 0) {
      const LogLightMatrix before = step(t - 1);
      diagonal += before - before * inverse[t - 1] * before;
      right[t] += before * (inverse[t - 1] * right[t - 1]);
    }
    inverse[t] = diagonal.ldlt().solve(LogLightMatrix::Identity());
  }
  // Backward: substitute.
  smoothed.light[count - 1] = inverse[count - 1] * right[count - 1];
  smoothed.covariance[count - 1] = inverse[count - 1];
  for (std::size_t t = count - 1; t-- > 0;) {
    const LogLightMatrix to_next = inverse[t] * step(t);
    smoothed.light[t] = inverse[t] * right[t] + to_next * smoothed.light[t + 1];
    smoothed.covariance[t] =
        inverse[t] + to_next * smoothed.covariance[t + 1] * to_next.transpose();
  }
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const LogLight moved = smoothed.light[i + 1] - smoothed.light[i];
    weight_[i] = (kFreedom + 6.0) / (kFreedom + moved.dot(precision_[i] * moved));
  }
  return smoothed;
}

}  // namespace pleinair::compositor
