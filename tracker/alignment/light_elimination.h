#pragma once

// Internal: between the .cc files of this module; not installed.

#include "tracker/alignment/block_sums.h"

namespace pleinair::tracker {

/// What a change of a block's gain and offset could do as well as the parameters: what is predicted
/// of it, a marker's white or an image, is p.
struct LightElimination {
  bool with_gain = false, possible = false;
  double w = 0.0, p = 0.0, pp = 0.0, determinant = 0.0;

  explicit LightElimination(const BlockMotions& sums) : w(sums.w), p(sums.p), pp(sums.pp) {
    determinant = w * pp - p * p;
    possible = w > 0.0;
    with_gain = determinant > 1e-9 * w * w;
  }
  /// How much of something, its sums with 1 and p, is like p …
  double OnPattern(double sum, double sum_p) const {
    return with_gain ? (w * sum_p - p * sum) / determinant : 0.0;
  }
  /// … and how much like a constant.
  double OnOne(double sum, double sum_p) const {
    return with_gain ? (pp * sum - p * sum_p) / determinant : sum / w;
  }
};

}  // namespace pleinair::tracker
