#include "tracker/refinement/marker_prediction.h"

#include <algorithm>
#include <cmath>

#include "tracker/pose/homography.h"

namespace pleinair::tracker {

Encoded Encode(double linear) {
  // IEC 61966-2-1, as in base/srgb.h.
  if (linear <= 0.0031308) return {255.0 * 12.92 * linear, 255.0 * 12.92};
  if (linear >= 1.0) return {255.0 * (1.0 + 1.055 / 2.4 * (linear - 1.0)), 255.0 * 1.055 / 2.4};
  const double power = std::pow(linear, 1.0 / 2.4);
  return {255.0 * (1.055 * power - 0.055), 255.0 * 1.055 / 2.4 * power / linear};
}

MarkerPrediction::MarkerPrediction(const MarkerPattern& pattern, const MarkerFitState& state)
    : pattern_(pattern),
      state_(state),
      marker_from_rays_(Adjugate(state.rays_from_marker)),
      blur_px_(std::exp(state.log_blur)) {}

Predicted MarkerPrediction::operator()(const MarkerPixel& pixel) const {
  Predicted predicted;
  const double extent = pattern_.Extent();
  predicted.marker = Apply(marker_from_rays_, pixel.ray);
  const Vec2 d_x = Apply(marker_from_rays_, pixel.ray + pixel.ray_d_x) - predicted.marker;
  const Vec2 d_y = Apply(marker_from_rays_, pixel.ray + pixel.ray_d_y) - predicted.marker;
  predicted.coverage = CoverageOfPixel(pattern_, predicted.marker, d_x, d_y, blur_px_);

  const auto grid = [&](double at) {
    return std::clamp((at / extent + 1.0) * 0.5 * (state_.nodes - 1), 0.0,
                      state_.nodes - 1.0 - 1e-9);
  };
  const double column = grid(predicted.marker.x), row = grid(predicted.marker.y);
  const int i = static_cast<int>(column), j = static_cast<int>(row);
  const double a = column - i, b = row - j;
  predicted.hat = {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
  predicted.node = {j * state_.nodes + i, j * state_.nodes + i + 1, (j + 1) * state_.nodes + i,
                    (j + 1) * state_.nodes + i + 1};
  double black = 0.0, white = 0.0;
  for (int k = 0; k < 4; ++k) {
    black += predicted.hat[k] * state_.levels[LevelIndex(predicted.node[k], 0)];
    white += predicted.hat[k] * state_.levels[LevelIndex(predicted.node[k], 1)];
  }
  predicted.contrast = white - black;
  const Encoded encoded = Encode(black + predicted.contrast * predicted.coverage.white);
  predicted.slope = encoded.slope;
  predicted.clipped = pixel.code >= 255.0 && encoded.code > 255.0;
  predicted.residual = predicted.clipped ? 0.0 : encoded.code - pixel.code;
  return predicted;
}

}  // namespace pleinair::tracker
