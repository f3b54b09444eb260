#include "compositor/photometry/changes/light_source.h"

#include <cmath>

namespace pleinair::compositor {
namespace {

// Error of the modelled sun over sky that all probes have in common, relative.
constexpr double kModelError = 0.05;
// Largest standard deviation of the logarithm of sun over sky for a reading of this kind.
constexpr double kToldBySurfaces = 0.1, kToldByColors = 0.3;

/// Standard deviation of log(sun over sky) by single channels: surfaces in sun and shade.
double ErrorBySurfaces(const LogLightMatrix& told) {
  double precision = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double a = told(c, c), b = told(c, 3 + c), d = told(3 + c, 3 + c);
    // Inverse of the 2 × 2 block, times (1, -1) on both sides.
    const double determinant = a * d - b * b, all = a + d + 2 * b;
    if (all > 0.0) precision += determinant / all;
  }
  return precision > 0.0 ? 1.0 / std::sqrt(precision) : INFINITY;
}

}  // namespace

LogLight RatioDirection() {
  LogLight direction;
  direction << 1.0, 1.0, 1.0, -1.0, -1.0, -1.0;
  return direction / 3.0;
}

double CommonModelError(double log_ratio) { return kModelError * std::expm1(-log_ratio); }

FrameLight::Source SourceOf(const LogLightMatrix& told, double log_ratio_error) {
  using Source = FrameLight::Source;
  if (told.isZero()) return Source::kHeld;
  if (ErrorBySurfaces(told) < kToldBySurfaces) return Source::kSurfaces;
  return log_ratio_error < kToldByColors ? Source::kColors : Source::kTotalOnly;
}

}  // namespace pleinair::compositor
