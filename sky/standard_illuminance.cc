#include "sky/standard_illuminance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sky/air_mass.h"
#include "sky/atmosphere/twilight.h"
#include "sky/sun/solar_disc.h"

namespace pleinair::sky {
namespace {

constexpr double kExtraterrestrialLux = 127'500.0;

/// 0 below `low`, 1 above `high`, smooth between.
double SmoothStep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double IesAirMass(Radians apparent_elevation) {
  const double kasten_young = RelativeAirMass(apparent_elevation);
  const double share = SmoothStep(6.0, 10.0, ToDegrees(apparent_elevation));
  if (share == 0.0) return kasten_young;
  return kasten_young + share * (1.0 / std::sin(apparent_elevation.value()) - kasten_young);
}

}  // namespace

StandardIlluminance ComputeStandardIlluminance(SkyCondition condition, Radians apparent_elevation,
                                               double distance_au) {
  const double sin_a = std::max(0.0, std::sin(apparent_elevation.value()));
  const double twilight = TwilightShare(apparent_elevation);
  const auto sun = [&](double extinction) {
    return kExtraterrestrialLux / (distance_au * distance_au) *
           std::exp(-extinction * IesAirMass(apparent_elevation)) *
           DiscShareAboveHorizon(apparent_elevation);
  };
  switch (condition) {
    case SkyCondition::kOvercast:
      return {Lux(0.0), Lux((300.0 + 21'000.0 * sin_a) * twilight)};
    case SkyCondition::kPartlyCloudy:
      return {Lux(sun(0.80)), Lux((300.0 + 45'000.0 * sin_a) * twilight)};
    case SkyCondition::kClear:
    case SkyCondition::kHazy:
      break;
  }
  return {Lux(sun(0.21)), Lux((800.0 + 15'500.0 * std::sqrt(sin_a)) * twilight)};
}

}  // namespace pleinair::sky
