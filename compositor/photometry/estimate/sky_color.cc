#include "compositor/photometry/estimate/sky_color.h"

#include <cmath>

#include "compositor/photometry/estimate/cell_model.h"

namespace pleinair::compositor {
namespace {

// Logarithmic error of the sky's color beside its sun: of the model, and common to all contrasts.
constexpr double kModelError = 0.10, kMeasuredError = 0.08;
// The same of a step within a cell.
constexpr double kStepError = 0.3;

LogRgb Predicted(const LightCell& cell, double log_sky_scale) {
  const LinearRgb scale = LinearRgb{1, 1, 1} * std::exp(log_sky_scale);
  return ContrastOf(OpenLight(cell, *cell.sunny, scale),
                    DarkLight(cell.shaded ? *cell.shaded : *cell.sunny, scale));
}

LogRgb Seen(const LightCell& cell) {
  if (!cell.shaded) return cell.step->contrast;
  LogRgb contrast = cell.sunny->log_rgb;
  for (std::size_t c = 0; c < 3; ++c) contrast[c] -= cell.shaded->log_rgb[c];
  return contrast;
}

}  // namespace

LogRgb FitSkyColor(const std::vector<WeightedContrast>& contrasts, double log_sky_scale) {
  LogRgb information{}, sum{};
  constexpr double kDelta = 0.02;
  for (const auto& [cell, weight] : contrasts) {
    const LogRgb seen = Seen(*cell), predicted = Predicted(*cell, log_sky_scale);
    const LogRgb more = Predicted(*cell, log_sky_scale + kDelta);
    const double sigma = cell->shaded ? ContrastError(*cell) : kStepError;
    // What the brightness says is in the scale already.
    const double brightness = Brightness(seen) - Brightness(predicted);
    for (std::size_t c = 0; c < 3; ++c) {
      const double slope = (more[c] - predicted[c]) / kDelta;
      information[c] += weight * slope * slope / (sigma * sigma);
      sum[c] += weight * slope * (seen[c] - predicted[c] - brightness) / (sigma * sigma);
    }
  }
  LogRgb color{};
  for (std::size_t c = 0; c < 3; ++c) {
    if (information[c] <= 0.0) return {};
    const double error = 1 / information[c] + kMeasuredError * kMeasuredError;
    constexpr double kPrior = kModelError * kModelError;
    color[c] = sum[c] / information[c] * kPrior / (kPrior + error);
  }
  const double luminance = Luminance({color[0], color[1], color[2]});
  for (double& value : color) value -= luminance;
  return color;
}

}  // namespace pleinair::compositor
