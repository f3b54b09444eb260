#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <vector>

#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/observed_patch.h"

namespace pleinair::tracker {

/// Estimates the noise of single pixels on a marker. Reuses its buffers.
class PixelNoiseEstimator {
 public:
  /// Standard deviation in shares of white, from the median difference of adjacent pixels where the
  /// marker is uniform; 0 if there are none. Occluders, shadow edges and blur are smooth and do not
  /// contribute. Call after Run() of `fit` on `observed`.
  double Share(const BlockFit& fit, const ObservedPatch& observed);

 private:
  std::vector<double> gains_;
  std::vector<float> differences_;
};

}  // namespace pleinair::tracker
