#include "tracker/refinement/marker_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pleinair::tracker {
namespace {

/// Minimum residual: rounding to 8 bits alone causes 0.29 digital numbers.
constexpr double kMinResidual_codes = 0.3;
/// Standard deviation of a Gaussian over its median absolute deviation.
constexpr double kSigmaPerMedian = 1.4826;
/// Minimum number of pixels that determine the noise of their kind.
constexpr std::size_t kEnough = 20;
/// Minimum edge gain of a pixel that determines the noise at edges: its noise is then many times
/// that off the edges.
constexpr double kEdgePixelGain_codes = 12.0;

double Median(std::vector<double>* values) {
  if (values->empty()) return 0.0;
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return *middle;
}

}  // namespace

double RobustScale(const std::vector<MarkerResidual>& residuals) {
  std::vector<double> sizes;
  sizes.reserve(residuals.size());
  for (const MarkerResidual& residual : residuals) sizes.push_back(std::fabs(residual.codes));
  return std::max(kMinResidual_codes, kSigmaPerMedian * Median(&sizes));
}

MarkerNoise EstimateMarkerNoise(const std::vector<MarkerResidual>& residuals) {
  std::vector<double> flat;
  for (const MarkerResidual& residual : residuals) {
    if (residual.edge_gain < kEdgePixelGain_codes) flat.push_back(std::fabs(residual.codes));
  }
  MarkerNoise noise;
  noise.flat_codes = flat.size() < kEnough
                         ? RobustScale(residuals)
                         : std::max(kMinResidual_codes, kSigmaPerMedian * Median(&flat));
  // Half of the edge pixels shall lie within the median of a Gaussian of variance flat² + share²
  // gain². Each pixel gives the share² from which on it does.
  std::vector<double> share_squared;
  for (const MarkerResidual& residual : residuals) {
    if (residual.edge_gain < kEdgePixelGain_codes) continue;
    const double sigma = kSigmaPerMedian * residual.codes;
    share_squared.push_back((sigma * sigma - noise.flat_codes * noise.flat_codes) /
                            (residual.edge_gain * residual.edge_gain));
  }
  if (share_squared.size() < kEnough) return noise;
  noise.edge_share = std::sqrt(std::max(0.0, Median(&share_squared)));
  return noise;
}

}  // namespace pleinair::tracker
