#include "sky/standard_illuminance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sky/air_mass.h"
#include "sky/perez.h"
#include "sky/solar_disc.h"
#include "sky/sunlight_spectrum.h"

namespace pleinair::sky {
namespace {

constexpr double kExtraterrestrialLux = 127'500.0;
// Iqbal 1983, model C: single-scattering albedo of the aerosol times its forward share.
constexpr double kScatteredToGround = 0.9 * 0.84;

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

double DefaultTurbidity(SkyCondition condition) {
  switch (condition) {
    case SkyCondition::kClear:
      return 2.5;
    case SkyCondition::kHazy:
      return 4.0;
    case SkyCondition::kPartlyCloudy:
    case SkyCondition::kOvercast:
      return 3.0;
  }
  return 2.5;
}

StandardIlluminance ComputeStandardIlluminance(SkyCondition condition, double turbidity,
                                               Radians apparent_elevation, double distance_au) {
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
  const double clear_sun = sun(0.21);
  const double clear_sky = 800.0 + 15'500.0 * std::sqrt(sin_a);
  const double reference = DefaultTurbidity(SkyCondition::kClear);
  const double ratio = turbidity == reference
                           ? 1.0
                           : LuminousTransmittance(turbidity, apparent_elevation) /
                                 LuminousTransmittance(reference, apparent_elevation);
  const double lost_on_ground = clear_sun * (1.0 - ratio) * sin_a;
  const double sky = std::max(0.5 * clear_sky, clear_sky + kScatteredToGround * lost_on_ground);
  return {Lux(clear_sun * ratio), Lux(sky * twilight)};
}

}  // namespace pleinair::sky
