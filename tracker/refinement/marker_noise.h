#pragma once

#include <vector>

namespace pleinair::tracker {

/// What a pixel of a marker does not agree with.
struct MarkerResidual {
  double codes = 0.0;      ///< Predicted less observed.
  double edge_gain = 0.0;  ///< Codes that an edge pixel's share of white is worth, 0 off edges.
};

/// How far pixels are from what is predicted. Pixels that an edge crosses carry more noise than
/// others: a lens and a renderer's few samples spread light otherwise than a Gaussian, sharpening
/// overshoots, edges of prints are rough. Their variance is taken as that of a share of white drawn
/// from so many samples, 4 c (1 - c), scaled to what the edges show.
struct MarkerNoise {
  double flat_codes = 0.0;  ///< Robust standard deviation off the edges.
  double edge_share = 0.0;  ///< Additional standard deviation of the share of white, where it is ½.

  double Variance(double edge_gain) const {
    const double edge_codes = edge_share * edge_gain;
    return flat_codes * flat_codes + edge_codes * edge_codes;
  }
};

/// Robust standard deviation of all residuals.
double RobustScale(const std::vector<MarkerResidual>& residuals);

/// Both from medians: up to half of either kind of pixel may be covered.
MarkerNoise EstimateMarkerNoise(const std::vector<MarkerResidual>& residuals);

}  // namespace pleinair::tracker
