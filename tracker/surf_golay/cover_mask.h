#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <vector>

#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/observed_patch.h"
#include "tracker/marker_pattern.h"
#include "tracker/surf_golay/cells/cell_light.h"

namespace pleinair::tracker {

/// Mask of occluders on a marker with known pattern. It contains pixels well inside white shapes
/// that are observed dark, pixels well inside black that are observed light, and their
/// surroundings, where an edge may belong to the occluder. A black occluder agrees with the
/// marker's black but not with its white: without the mask, nearly black pixels at the edges would
/// still bias a robust fit.
class CoverMask {
 public:
  /// Converts the window's values to shares of white by `light`, and stores the originals. `fit`
  /// has evaluated the marker on it.
  void TakeShares(const MarkerPattern& pattern, const BlockFit& fit, const MarkerLight& light,
                  ObservedPatch* observed);

  /// Whether pixels at edges of the marker indicate occluders: only if the marker's position is
  /// accurate to a fraction of a pixel and the light is uniform.
  enum class Edges { kUnreliable, kReliable };

  /// Threshold for an occluded pixel on white: darker than white by a clear amount, or also beyond
  /// noise. The latter keeps dark noise, without which white would be overestimated.
  enum class Dark { kPlain, kBeyondNoise };

  /// Sets the weight of occluded pixels of the window to zero, from the last prediction of `fit`.
  /// `blur_px`: blur of the image (standard deviation, pixels of the window).
  void Lay(const BlockFit& fit, double blur_px, Edges edges, ObservedPatch* observed,
           Dark darkness = Dark::kPlain);

  /// Restores the window's original values.
  void RestoreValues(ObservedPatch* observed) const { observed->value = value_; }
  /// Restores the original inverse variances, as if nothing were occluded.
  void RestoreWeights(ObservedPatch* observed) const {
    observed->inverse_variance = inverse_variance_;
  }

 private:
  std::vector<float> value_, share_, inverse_variance_;
  float min_light_ = 0.0F;   ///< Share of white above which a pixel is not black.
  float noisy_dark_ = 0.0F;  ///< Share of white below which a white pixel is not explained by noise
                             ///< (kBeyondNoise).
  std::vector<unsigned char> covered_, beside_;
};

}  // namespace pleinair::tracker
