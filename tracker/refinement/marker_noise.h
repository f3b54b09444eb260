#pragma once

#include <vector>

namespace pleinair::tracker {

/// Residual of a pixel of a marker.
struct MarkerResidual {
  double codes = 0.0;      ///< Predicted minus observed, 8-bit values.
  double edge_gain = 0.0;  ///< 8-bit values per unit of white coverage of an edge pixel; 0 away
                           ///< from edges.
};

/// Noise model of the residuals. Edge pixels have more noise than others: lenses and the few
/// samples of renderers blur differently from a Gaussian, sharpening overshoots, printed edges are
/// rough. Their extra variance is that of a share of white estimated from a few samples, 4 c (1 -
/// c), scaled to the observed residuals at edges.
struct MarkerNoise {
  double flat_codes = 0.0;  ///< Robust standard deviation away from edges.
  double edge_share = 0.0;  ///< Additional standard deviation of the coverage where it is ½.

  double Variance(double edge_gain) const {
    const double edge_codes = edge_share * edge_gain;
    return flat_codes * flat_codes + edge_codes * edge_codes;
  }
};

/// Robust standard deviation of all residuals.
double RobustScale(const std::vector<MarkerResidual>& residuals);

/// Both values are estimated by medians: up to half of the pixels of either kind may be covered.
MarkerNoise EstimateMarkerNoise(const std::vector<MarkerResidual>& residuals);

}  // namespace pleinair::tracker
