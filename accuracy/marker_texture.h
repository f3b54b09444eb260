#pragma once

#include <vector>

#include "base/vector.h"
#include "tracker/marker_pattern.h"

namespace pleinair::accuracy {

/// A print as an integral over its modules, so that the mean over any upright box of it is exact:
/// what the frames are sampled from. (Crow 1984, "Summed-area tables for texture mapping".)
class MarkerTexture {
 public:
  explicit MarkerTexture(const tracker::MarkerPattern& pattern);

  double extent() const { return extent_; }  ///< Half edges.
  int modules() const { return modules_; }

  /// Share of white in the box about `at` (modules from the top-left, x right, y down) with these
  /// half sides; what lies outside the print counts as the print's rim.
  double White(Vec2 at, double half_width, double half_height) const;

 private:
  double Integral(double x, double y) const;

  int modules_;
  double extent_;
  std::vector<double> sums_;  ///< White modules above and left of each corner.
};

}  // namespace pleinair::accuracy
