#pragma once

#include <optional>
#include <vector>

#include "tracker/alignment/block_fit.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// The straight edge of a shadow on a marker, in units of the marker.
struct ShadowEdge {
  double u = 1.0, v = 0.0, at = 0.0;  ///< Beyond u' u + v' v = at, for a place (u', v') …
  double log_step = 0.0;              ///< … white's logarithm is this much higher.

  bool IsBeyond(double place_u, double place_v) const { return u * place_u + v * place_v > at; }
};

/// How bright white and black are across a marker, learned where the marker is known. White's
/// logarithm is a plane, or two planes of one slope on either side of a straight edge of shadow;
/// black is a constant share of white.
struct MarkerLight {
  // In units of the marker: half edges from the centre, u right, v down.
  double log_white = 0.0, slope_u = 0.0, slope_v = 0.0;
  std::optional<ShadowEdge> edge;
  double black_share = 0.05;
  double spread = 0.0;  ///< Robust standard deviation of what is left over, in log white.
  /// Standard deviation of a pixel's share of white, from noise and texture, on white and on black.
  double white_noise = 0.02, black_noise = 0.01;
  bool white_clips = false;  ///< White is brighter than the image can hold.

  double White(double u, double v) const;
  double LogWhite(double u, double v) const;
};

/// Learns the light of a marker from the pixels that a fit of its border believes in. `seen` is
/// what was fitted, but clipped pixels count as white at its brightest.
class MarkerLightEstimator {
 public:
  /// False where too little of the border is observed. `brightest`: what most pixels agree on may
  /// be a cover; the brightest of them is taken for paper.
  bool Measure(const MarkerPattern& pattern, const BlockFit& fit, const ObservedPatch& observed,
               bool brightest, MarkerLight* light);

 private:
  struct Sample {
    float u, v, log_value, share, weight;
  };
  /// Of prints too small for a pixel to be all white or all black: even light, from the blocks.
  static bool FromBlocks(const BlockFit& fit, MarkerLight* light);
  void FitPlane(bool brightest, MarkerLight* light);
  std::optional<ShadowEdge> FitEdge() const;
  double Spread(const MarkerLight& light);

  std::vector<Sample> white_, black_;
  std::vector<float> residuals_;
};

}  // namespace pleinair::tracker
