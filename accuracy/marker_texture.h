#pragma once

#include <vector>

#include "base/vector.h"
#include "tracker/marker_pattern.h"

namespace pleinair::accuracy {

/// A marker as a summed-area table over its modules, so that the mean over any axis-aligned box is
/// exact; the frames are sampled from it. (Crow 1984, "Summed-area tables for texture mapping".)
class MarkerTexture {
 public:
  explicit MarkerTexture(const tracker::MarkerPattern& pattern);

  double extent() const { return extent_; }  ///< Half edges.
  int modules() const { return modules_; }

  /// Share of white in the box around `at` (modules from the top-left, x right, y down) with these
  /// half sides; the marker's outermost modules are extended beyond it.
  double White(Vec2 at, double half_width, double half_height) const;

 private:
  double Integral(double x, double y) const;

  int modules_;
  double extent_;
  std::vector<double> sums_;  ///< White modules above and left of each corner.
};

}  // namespace pleinair::accuracy
