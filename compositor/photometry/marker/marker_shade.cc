#include "compositor/photometry/marker/marker_shade.h"

#include <algorithm>
#include <cmath>

namespace pleinair::compositor {

LinearRgb MarkerShadeCorrection(double sunlit_scale, LinearRgb sun, LinearRgb sky) {
  if (!(std::min({sun.r, sun.g, sun.b}) > 0.0)) return {1, 1, 1};
  const auto shade = [&](double part) { return (sun + sky) / (sun * part + sky); };
  double minimum = 0.0, maximum = 1.0;
  constexpr int kBisections = 20;
  for (int i = 0; i < kBisections; ++i) {
    const double part = (minimum + maximum) / 2;
    (MeanLog(shade(part)) > std::log(sunlit_scale) ? minimum : maximum) = part;
  }
  const LinearRgb shaded = shade((minimum + maximum) / 2);
  return shaded * std::sqrt(std::max(1.0, sunlit_scale / std::exp(MeanLog(shaded))));
}

}  // namespace pleinair::compositor
