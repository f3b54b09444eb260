#include "compositor/photometry/sample_medians.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/quantile.h"

namespace pleinair::compositor {

std::pair<double, double> MedianBrightness(const SurfaceSamples& samples,
                                           std::span<const std::uint32_t> members, int channel) {
  std::vector<double> values;
  values.reserve(members.size());
  for (const std::uint32_t member : members) {
    const auto& log_rgb = samples.samples()[member].log_rgb;
    values.push_back(channel >= 0 ? log_rgb[channel] : (log_rgb[0] + log_rgb[1] + log_rgb[2]) / 3);
  }
  const double median = Median(values);
  for (double& value : values) value = std::fabs(value - median);
  // For a normal distribution: 1.4826 converts a median absolute deviation to a standard deviation.
  // π/2 is the variance of a median over that of a mean.
  const double sigma = 1.4826 * Median(values);
  return {median, 1.571 * sigma * sigma / static_cast<double>(values.size())};
}

Point<Marker> MiddleOf(const SurfaceSamples& samples, std::span<const std::uint32_t> members) {
  Vec3 mean;
  for (const std::uint32_t member : members) mean = mean + samples.samples()[member].point.xyz;
  mean = mean * (1.0 / static_cast<double>(members.size()));
  const auto nearest = std::min_element(members.begin(), members.end(), [&](auto a, auto b) {
    return Norm(samples.samples()[a].point.xyz - mean) <
           Norm(samples.samples()[b].point.xyz - mean);
  });
  return samples.samples()[*nearest].point;
}

}  // namespace pleinair::compositor
