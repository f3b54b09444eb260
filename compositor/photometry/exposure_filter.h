#pragma once

#include <cstddef>
#include <deque>

#include "base/vector.h"

namespace pleinair::compositor {

/// The camera's exposure scale (display-linear value per cd/m², per channel) from what the marker
/// told in one frame after the other, and how much it changed meanwhile.
class ExposureFilter {
 public:
  /// A frame's estimate with its relative error, one standard deviation.
  void Add(const LinearRgb& exposure_scale, const LinearRgb& error);

  bool empty() const { return recent_.empty(); }

  /// The median of the last fifteen readings, or of all while there are fewer, each channel by
  /// itself. At least one estimate.
  LinearRgb ExposureScale() const;

  /// Relative standard deviation of ExposureScale(), each channel: what readings scatter from frame
  /// to frame grows less in a median of many; a frame's own error does not, since the next shows
  /// the same print. At least one estimate.
  LinearRgb Error() const;

  /// The brightest exposure scale over the darkest, of the channel that changed most; 1 until there
  /// are more than five readings. Each is the median of five in a row: two bad ones among them, of
  /// a hand or a highlight, are not taken for a change.
  double Change() const;

 private:
  struct Estimate {
    LinearRgb exposure_scale, error;
  };

  /// Of the last `count` readings, or of all where there are fewer, each channel by itself.
  template <typename Value>
  LinearRgb MedianOfLast(std::size_t count, const Value& value) const;

  std::deque<Estimate> recent_;
  LinearRgb min_, max_;  // Of the medians of five.
};

}  // namespace pleinair::compositor
