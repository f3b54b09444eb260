#pragma once

// Internal: between the .cc files of this module; not installed.

#include <vector>

#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/observed_patch.h"
#include "tracker/marker_pattern.h"
#include "tracker/surf_golay/cell_light.h"

namespace pleinair::tracker {

/// Where something lies on a marker that is known: pixels well inside a white shape that are
/// observed dark, or well inside the black that are observed light, and all that is so near to them
/// that an edge of the marker there may be the cover's. What looks like ink agrees with the
/// marker's black, but not with its white: without the mask the feet of the edges between, which
/// are nearly black, still draw a robust fit.
class CoverMask {
 public:
  /// Turns the window's values into shares of white by `light`, and remembers what they were.
  /// `fit` has evaluated the marker on it.
  void TakeShares(const MarkerPattern& pattern, const BlockFit& fit, const MarkerLight& light,
                  ObservedPatch* observed);

  /// What pixels at edges of the marker tell of covers: something where the marker lies to a
  /// fraction of a pixel where it is predicted, in plain light.
  enum class Edges { kUnreliable, kReliable };

  /// How dark a pixel on white is covered: darker than white plainly is, or than noise makes it,
  /// too. The latter keeps dark noise, without which white would be taken for too bright.
  enum class Dark { kPlain, kBeyondNoise };

  /// Makes covered pixels of the window count for nothing, by what `fit` predicted last of a
  /// image of this blur (standard deviation, the window's pixels).
  void Lay(const BlockFit& fit, double blur_px, Edges edges, ObservedPatch* observed,
           Dark darkness = Dark::kPlain);

  /// Gives the window its values back.
  void RestoreValues(ObservedPatch* observed) const { observed->value = value_; }
  /// … and its inverse variance: as if nothing were covered.
  void RestoreWeights(ObservedPatch* observed) const {
    observed->inverse_variance = inverse_variance_;
  }

 private:
  std::vector<float> value_, share_, inverse_variance_;
  float min_light_ = 0.0F;   ///< Share of white that is no ink.
  float noisy_dark_ = 0.0F;  ///< Share of white below which white is no noise (kBeyondNoise).
  std::vector<unsigned char> covered_, beside_;
};

}  // namespace pleinair::tracker
