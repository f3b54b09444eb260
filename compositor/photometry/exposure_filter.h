#pragma once

#include <cstddef>
#include <deque>

#include "base/vector.h"

namespace pleinair::compositor {

/// Filters the camera's exposure scale (display-linear value per cd/m², per channel) over the
/// frames' marker estimates. It also reports how much the scale changed meanwhile.
class ExposureFilter {
 public:
  /// Adds a frame's estimate with its relative error, one standard deviation.
  void Add(const LinearRgb& exposure_scale, const LinearRgb& error);

  bool empty() const { return recent_.empty(); }

  /// Median of the last fifteen estimates, or of all while there are fewer, per channel. Needs at
  /// least one estimate.
  LinearRgb ExposureScale() const;

  /// Relative standard deviation of ExposureScale(), per channel. A median of many estimates
  /// reduces the scatter between frames. It does not reduce a frame's own error, because the next
  /// frame shows the same marker. Needs at least one estimate.
  LinearRgb Error() const;

  /// Ratio of the maximum to the minimum exposure scale, for the channel that changed most. It is 1
  /// up to five estimates. Each value is a median of five consecutive estimates. Two outliers among
  /// them, such as a hand or a highlight, are therefore not taken for a change.
  double Change() const;

 private:
  struct Estimate {
    LinearRgb exposure_scale, error;
  };

  /// Median of the last `count` estimates, or of all where there are fewer, per channel.
  template <typename Value>
  LinearRgb MedianOfLast(std::size_t count, const Value& value) const;

  std::deque<Estimate> recent_;
  LinearRgb min_, max_;  // Over the medians of five.
};

}  // namespace pleinair::compositor
