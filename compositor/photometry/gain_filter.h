#pragma once

#include <cstddef>
#include <deque>

#include "base/vector.h"

namespace pleinair::compositor {

/// The camera's gain (display-linear value per cd/m², per channel) from what the marker told in
/// one frame after the other, and how much it changed meanwhile.
class GainHistory {
 public:
  /// A frame's reading with its relative error, one standard deviation.
  void Add(const LinearRgb& gain, const LinearRgb& error);

  bool empty() const { return recent_.empty(); }

  /// The median of the last fifteen readings, or of all while there are fewer, each channel by
  /// itself. At least one reading.
  LinearRgb Gain() const;

  /// Relative standard deviation of Gain(), each channel: what readings scatter from frame to frame
  /// grows less in a median of many; a frame's own error does not, since the next shows the same
  /// print. At least one reading.
  LinearRgb Error() const;

  /// The brightest gain over the darkest, of the channel that changed most; 1 until there are more
  /// than five readings. Each is the median of five in a row: two bad ones among them, of a hand
  /// or a highlight, are not taken for a change.
  double Change() const;

 private:
  struct Reading {
    LinearRgb gain, error;
  };

  /// Of the last `count` readings, or of all where there are fewer, each channel by itself.
  template <typename Value>
  LinearRgb MedianOfLast(std::size_t count, const Value& value) const;

  std::deque<Reading> recent_;
  LinearRgb least_, most_;  // Of the medians of five.
};

}  // namespace pleinair::compositor
