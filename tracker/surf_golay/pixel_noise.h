#pragma once

// Internal: between the .cc files of this module; not installed.

#include <vector>

#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/observed_patch.h"

namespace pleinair::tracker {

/// Measures the noise of single pixels on a marker. Keeps its buffers.
class PixelNoiseEstimator {
 public:
  /// Standard deviation in shares of white, from the median difference of neighbours where the
  /// marker is even; 0 where there are none. What covers a marker, shadows' edges and blur, which
  /// are smooth, are not in it. After a Run of `fit` on `seen`.
  double Share(const BlockFit& fit, const ObservedPatch& observed);

 private:
  std::vector<double> gains_;
  std::vector<float> differences_;
};

}  // namespace pleinair::tracker
