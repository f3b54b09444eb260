#include "sky/atmosphere/twilight.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pleinair::sky {

double TwilightShare(Radians apparent_elevation) {
  struct Node {
    double elevation_deg, log10_lux;
  };
  static constexpr Node kNodes[] = {{-18.0, -3.19}, {-15.0, -2.69}, {-12.0, -2.09}, {-9.0, -0.93},
                                    {-6.0, 0.53},   {-5.0, 1.02},   {-4.0, 1.48},   {-3.0, 1.90},
                                    {-2.0, 2.28},   {-1.0, 2.61},   {0.0, 2.88}};
  const double elevation_deg = ToDegrees(apparent_elevation);
  if (elevation_deg >= 0.0) return 1.0;
  constexpr double kLogAtHorizon = 2.88;
  const auto share = [&](double log10_lux) { return std::pow(10.0, log10_lux - kLogAtHorizon); };
  if (elevation_deg <= kNodes[0].elevation_deg) return share(kNodes[0].log10_lux);
  const Node* upper = std::find_if(std::begin(kNodes), std::end(kNodes), [&](const Node& node) {
    return node.elevation_deg >= elevation_deg;
  });
  const Node* lower = upper - 1;
  const double t =
      (elevation_deg - lower->elevation_deg) / (upper->elevation_deg - lower->elevation_deg);
  return share(lower->log10_lux + t * (upper->log10_lux - lower->log10_lux));
}

ComputedTwilight TwilightToCompute(double sun_elevation) {
  constexpr double kDeepest = -9.0 * kRadiansPerDegree;
  if (sun_elevation >= kDeepest) return {sun_elevation, 1.0};
  static const double kNight = TwilightShare(FromDegrees(-18.0));
  static const double kThere = TwilightShare(Radians(kDeepest)) - kNight;
  return {kDeepest, (TwilightShare(Radians(sun_elevation)) - kNight) / kThere};
}

}  // namespace pleinair::sky
