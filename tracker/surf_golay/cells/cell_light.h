#pragma once

#include <optional>
#include <vector>

#include "tracker/alignment/block_fit.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// A straight shadow edge on the marker, in units of the marker.
struct ShadowEdge {
  double u = 1.0, v = 0.0, at = 0.0;  ///< On the side u' u + v' v > at of a point (u', v') …
  double log_step = 0.0;              ///< … the logarithm of white is higher by this.

  bool IsBeyond(double place_u, double place_v) const { return u * place_u + v * place_v > at; }
};

/// Light model of a marker, fitted where its pattern is known. The logarithm of white is a plane,
/// or two planes of equal slope on either side of a straight shadow edge. Black is a constant share
/// of white.
struct MarkerLight {
  // In units of the marker: half edges from the centre, u right, v down.
  double log_white = 0.0, slope_u = 0.0, slope_v = 0.0;
  std::optional<ShadowEdge> edge;
  double black_share = 0.05;
  double spread = 0.0;  ///< Robust standard deviation of the residuals, in log white.
  /// Standard deviation of a pixel's share of white on white and on black, from noise and texture.
  double white_noise = 0.02, black_noise = 0.01;
  bool white_clips = false;  ///< White is clipped in the image.

  double White(double u, double v) const;
  double LogWhite(double u, double v) const;
};

/// Estimates the light of a marker from the pixels with high robust weight in a fit of its border.
/// `observed` is the patch that was fitted; clipped pixels count as white at its brightest.
class MarkerLightEstimator {
 public:
  /// Returns false if too little of the border is visible. `brightest`: most pixels may belong to
  /// an occluder, so the brightest ones are taken for paper.
  bool Measure(const MarkerPattern& pattern, const BlockFit& fit, const ObservedPatch& observed,
               bool brightest, MarkerLight* light);

 private:
  struct Sample {
    float u, v, log_value, share, weight;
  };
  /// For markers too small for a pixel to be all white or all black: uniform light, from the
  /// blocks.
  static bool FromBlocks(const BlockFit& fit, MarkerLight* light);
  void FitPlane(bool brightest, MarkerLight* light);
  std::optional<ShadowEdge> FitEdge() const;
  double Spread(const MarkerLight& light);

  std::vector<Sample> white_, black_;
  std::vector<float> residuals_;
};

}  // namespace pleinair::tracker
