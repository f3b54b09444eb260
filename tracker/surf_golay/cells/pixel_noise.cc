#include "tracker/surf_golay/cells/pixel_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pleinair::tracker {
namespace {

/// Difference of predicted shares of white below which they count as equal.
constexpr float kEven = 0.02F;
/// Median of |x - y| of two Gaussian numbers, divided by their standard deviation: √2 Φ⁻¹(3/4).
constexpr double kMedianDifference = 0.9539;

template <typename T>
T Median(std::vector<T>* values) {
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return *middle;
}

}  // namespace

double PixelNoiseEstimator::Share(const BlockFit& fit, const ObservedPatch& observed) {
  gains_.clear();
  gains_.reserve(fit.blocks().size());
  for (const MarkerBlock& block : fit.blocks()) {
    if (block.gain > 0.0) gains_.push_back(block.gain);
  }
  differences_.clear();
  differences_.reserve(observed.value.size());
  const int width = observed.rays.window.width, height = observed.rays.window.height;
  const std::vector<float>& white = fit.image().white;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x + 1 < width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * width + x;
      if (!(observed.inverse_variance[at] > 0.0F && observed.inverse_variance[at + 1] > 0.0F))
        continue;
      if (std::fabs(white[at] - white[at + 1]) > kEven) continue;
      differences_.push_back(std::fabs(observed.value[at] - observed.value[at + 1]));
    }
  }
  if (differences_.empty() || gains_.empty()) return 0.0;
  return Median(&differences_) / (kMedianDifference * Median(&gains_));
}

}  // namespace pleinair::tracker
