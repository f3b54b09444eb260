#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// Median of the logarithmic brightness of some samples, and the variance of that median.
/// `channel`: 0 to 2, or −1 for the mean of the channels. `members` are indices into the samples;
/// at least one.
std::pair<double, double> MedianBrightness(const SurfaceSamples& samples,
                                           std::span<const std::uint32_t> members, int channel);

/// The sample nearest to the centroid of some.
Point<Marker> MiddleOf(const SurfaceSamples& samples, std::span<const std::uint32_t> members);

}  // namespace pleinair::compositor
