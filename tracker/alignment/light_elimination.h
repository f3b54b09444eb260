#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include "tracker/alignment/block_sums.h"

namespace pleinair::tracker {

/// Projects onto the changes that a block's gain and offset can make. p is the prediction: the
/// marker's share of white, or a target's image.
struct LightElimination {
  bool with_gain = false, possible = false;
  double w = 0.0, p = 0.0, pp = 0.0, determinant = 0.0;

  explicit LightElimination(const BlockMotions& sums) : w(sums.w), p(sums.p), pp(sums.pp) {
    determinant = w * pp - p * p;
    possible = w > 0.0;
    with_gain = determinant > 1e-9 * w * w;
  }
  /// Component along the prediction of a quantity given by its sums with 1 and p.
  double OnPattern(double sum, double sum_p) const {
    return with_gain ? (w * sum_p - p * sum) / determinant : 0.0;
  }
  /// Component along a constant.
  double OnOne(double sum, double sum_p) const {
    return with_gain ? (pp * sum - p * sum_p) / determinant : sum / w;
  }
};

}  // namespace pleinair::tracker
