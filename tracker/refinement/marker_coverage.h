#pragma once

#include "base/vector.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// White coverage of one pixel, with derivatives.
struct Coverage {
  double white = 0.0;       ///< Share of the pixel's light from white paper, 0…1.
  double d_u = 0.0;         ///< Derivative by the pixel's marker coordinate u (half edges),
  double d_v = 0.0;         ///< … by v,
  double d_log_blur = 0.0;  ///< … by the logarithm of the blur.
  bool uniform = true;      ///< No edge of the marker within reach: all derivatives are 0.
};

/// Integrates the marker over a square pixel and a Gaussian blur of standard deviation `blur_px`.
/// `centre`: the pixel's centre in marker coordinates (half edges, y up); `d_x`, `d_y`: derivatives
/// of those coordinates by the pixel's x and y. The outermost modules are extended beyond the quiet
/// zone.
///
/// The marker is a grid, so its blurred value is Σ_ij white_ij W_i(u) W_j(v), where W_i is the
/// share of a Gaussian in column i. Approximations: the Gaussian is separable in u and v, exact at
/// straight edges; the pixel's square is a 2×2 comb of sub-squares whose moments up to the third
/// are exact and whose fourth is 4 % off.
Coverage CoverageOfPixel(const MarkerPattern& pattern, Vec2 centre, Vec2 d_x, Vec2 d_y,
                         double blur_px);

}  // namespace pleinair::tracker
