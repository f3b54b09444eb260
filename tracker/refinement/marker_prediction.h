#pragma once

// Internal: between the .cc files of this module; not installed.

#include <Eigen/Dense>
#include <array>

#include "base/vector.h"
#include "tracker/marker_pattern.h"
#include "tracker/refinement/marker_coverage.h"
#include "tracker/refinement/marker_pixels.h"

namespace pleinair::tracker {

/// sRGB code (0…255) of linear light and its slope, continued beyond 0…1 so that a fit can come
/// back from there.
struct Encoded {
  double code, slope;
};
Encoded Encode(double linear);

/// What a fit of a marker varies.
struct MarkerFitState {
  Mat3 rays_from_marker;  ///< Homography from the marker (half edges, y up) to normalised rays.
  double log_blur = 0.0;
  int nodes = 2;           ///< Level nodes along each side.
  Eigen::VectorXd levels;  ///< Black and white of each node, in linear light.
};

/// Place of a node's black (0) or white (1) among the levels.
inline int LevelIndex(int node, int white) { return 2 * node + white; }

/// What one pixel should hold, against what it holds.
struct Predicted {
  Vec2 marker;  ///< The pixel's centre on the marker.
  Coverage coverage;
  std::array<double, 4> hat;  ///< Weights of the four level nodes around it,
  std::array<int, 4> node;    ///< … which are these, ascending.
  double contrast = 0.0;      ///< White less black here, linear light.
  double slope = 0.0;         ///< Codes per linear light.
  double residual = 0.0;      ///< Predicted less observed, codes.
  bool clipped = false;       ///< Both are beyond white: nothing to learn.
};

/// Predicts pixel after pixel from one state.
class MarkerPrediction {
 public:
  MarkerPrediction(const MarkerPattern& pattern, const MarkerFitState& state);
  Predicted operator()(const MarkerPixel& pixel) const;

 private:
  const MarkerPattern& pattern_;
  const MarkerFitState& state_;
  const Mat3 marker_from_rays_;
  const double blur_px_;
};

}  // namespace pleinair::tracker
