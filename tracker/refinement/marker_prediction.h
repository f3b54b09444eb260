#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <Eigen/Dense>
#include <array>

#include "base/vector.h"
#include "tracker/marker_pattern.h"
#include "tracker/refinement/marker_coverage.h"
#include "tracker/refinement/marker_pixels.h"

namespace pleinair::tracker {

/// sRGB-encoded value (0…255) of linear light and its slope, extrapolated beyond 0…1 so that a fit
/// can return from there.
struct Encoded {
  double code, slope;
};
Encoded Encode(double linear);

/// Parameters of a marker fit.
struct MarkerFitState {
  Mat3 rays_from_marker;  ///< Homography from the marker (half edges, y up) to normalised rays.
  double log_blur = 0.0;
  int nodes = 2;           ///< Nodes of the light levels along each side.
  Eigen::VectorXd levels;  ///< Black and white level of each node, linear light.
};

/// Index of a node's black (0) or white (1) level.
inline int LevelIndex(int node, int white) { return 2 * node + white; }

/// Prediction and residual of one pixel.
struct Predicted {
  Vec2 marker;  ///< The pixel's centre on the marker.
  Coverage coverage;
  std::array<double, 4> hat;  ///< Weights of the four surrounding level nodes,
  std::array<int, 4> node;    ///< … and their indices, ascending.
  double contrast = 0.0;      ///< Local white minus black, linear light.
  double slope = 0.0;         ///< 8-bit values per linear light.
  double residual = 0.0;      ///< Predicted minus observed, 8-bit values.
  bool clipped = false;       ///< Predicted and observed value are both clipped at white: no
                              ///< information.
};

/// Predicts pixels one by one from a given state.
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
