#pragma once

#include <deque>

#include "base/vector.h"

namespace pleinair::app {

/// The camera's gain (display-linear value per cd/m², per channel) from what the marker told in
/// one frame after the other, and how much it changed meanwhile.
class GainHistory {
 public:
  void Add(const LinearRgb& gain);

  bool empty() const { return recent_.empty(); }

  /// The median of the last fifteen readings, or of all while there are fewer, each channel by
  /// itself. At least one reading.
  LinearRgb Gain() const;

  /// The brightest gain over the darkest, of the channel that changed most; 1 until there are more
  /// than five readings. Each is the median of five in a row: two bad ones among them, of a hand
  /// or a highlight, are not taken for a change.
  double Change() const;

 private:
  std::deque<LinearRgb> recent_;
  LinearRgb least_, most_;  // Of the medians of five.
};

}  // namespace pleinair::app
