#include "compositor/photometry/marker/marker_shade.h"

#include <algorithm>
#include <cmath>

namespace pleinair::compositor {

LinearRgb PrintShade(double open_gain, LinearRgb sun, LinearRgb sky) {
  if (!(std::min({sun.r, sun.g, sun.b}) > 0.0)) return {1, 1, 1};
  const auto shade = [&](double part) { return (sun + sky) / (sun * part + sky); };
  double least = 0.0, most = 1.0;
  constexpr int kBisections = 20;
  for (int i = 0; i < kBisections; ++i) {
    const double part = (least + most) / 2;
    (MeanLog(shade(part)) > std::log(open_gain) ? least : most) = part;
  }
  const LinearRgb shaded = shade((least + most) / 2);
  return shaded * std::sqrt(std::max(1.0, open_gain / std::exp(MeanLog(shaded))));
}

}  // namespace pleinair::compositor
