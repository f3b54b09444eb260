#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "compositor/lens/blur_parabola.h"
#include "compositor/lens/focus_fit.h"

namespace pleinair::compositor {

/// Readings of blur, and how much each counts in a fit of squared blur.
struct WeighedReadings {
  explicit WeighedReadings(std::span<const BlurReading> all);

  std::span<const BlurReading> readings;
  std::vector<double> neighbours;  ///< How many readings lie at about the distance of each.
  std::vector<double> weights;     ///< Inverse variances, 1/px⁴; 0: left out.
  std::vector<bool> is_moved;      ///< Left out by the caller.

  /// Variance of a reading whose expected squared blur is this, px⁴. Readings at one distance share
  /// a part of it: edges and pixel grid are the same there.
  double Variance(std::size_t i, double squared_blur) const;
  /// Weights from the fitted blur, with Huber's function (P. J. Huber 1964); null: from each
  /// reading's own. Those would favour readings that are too small.
  void WeighBy(const BlurParabola* fitted);
  /// Sum of squares over degrees of freedom, at least 1: formal errors are scaled by its root.
  double ReducedChiSquared(const BlurParabola& fitted, int unknowns) const;
  std::size_t CountUsed() const;
};

/// Groups of frames of which one is left out in turn.
inline constexpr int kJackknifeGroups = 8;

/// Weights without the frames of a group, 0…kJackknifeGroups − 1.
std::vector<double> WeightsWithout(const WeighedReadings& weighed, int group);

/// Standard errors of `kCount` numbers by leaving out an eighth of the frames in turn, with
/// Student's t for so few groups. `fit` receives the weights. Infinite where it returns nothing.
template <std::size_t kCount, typename Fit>
std::array<double, kCount> JackknifeErrors(const WeighedReadings& weighed, const Fit& fit) {
  // Student's t for eight groups over the normal distribution, at 95 %.
  constexpr double kFewGroups = 2.365 / 1.96;
  std::array<std::array<double, kCount>, kJackknifeGroups> values{};
  std::array<double, kCount> errors{};
  for (int group = 0; group < kJackknifeGroups; ++group) {
    const std::optional<std::array<double, kCount>> found = fit(WeightsWithout(weighed, group));
    if (!found) {
      errors.fill(std::numeric_limits<double>::infinity());
      return errors;
    }
    values[static_cast<std::size_t>(group)] = *found;
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    double mean = 0.0, squares = 0.0;
    for (const auto& value : values) mean += value[i] / kJackknifeGroups;
    for (const auto& value : values) squares += (value[i] - mean) * (value[i] - mean);
    errors[i] = kFewGroups * std::sqrt(squares * (kJackknifeGroups - 1) / kJackknifeGroups);
  }
  return errors;
}

}  // namespace pleinair::compositor
