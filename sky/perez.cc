#include "sky/perez.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sky/atmosphere/twilight.h"
#include "sky/dome.h"
#include "sky/sun/sun_direction.h"

namespace pleinair::sky {
namespace {

using std::numbers::pi;

// Preetham et al. 1999, A.2: each coefficient is slope · T + offset.
struct Linear {
  double slope, offset;
  double At(double turbidity) const { return slope * turbidity + offset; }
};
constexpr std::array<Linear, 5> kLuminance = {{{0.1787, -1.4630},
                                               {-0.3554, 0.4275},
                                               {-0.0227, 5.3251},
                                               {0.1206, -2.5771},
                                               {-0.0670, 0.3703}}};
constexpr std::array<Linear, 5> kChromaticityX = {{{-0.0193, -0.2592},
                                                   {-0.0665, 0.0008},
                                                   {-0.0004, 0.2125},
                                                   {-0.0641, -0.8989},
                                                   {-0.0033, 0.0452}}};
constexpr std::array<Linear, 5> kChromaticityY = {{{-0.0167, -0.2608},
                                                   {-0.0950, 0.0092},
                                                   {-0.0079, 0.2102},
                                                   {-0.0441, -1.6537},
                                                   {-0.0109, 0.0529}}};

// Zenith chromaticity: [T² T 1] M [θ³ θ² θ 1]ᵀ.
using ZenithMatrix = std::array<std::array<double, 4>, 3>;
constexpr ZenithMatrix kZenithX = {{{0.00166, -0.00375, 0.00209, 0.0},
                                    {-0.02903, 0.06377, -0.03202, 0.00394},
                                    {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr ZenithMatrix kZenithY = {{{0.00275, -0.00610, 0.00317, 0.0},
                                    {-0.04214, 0.08970, -0.04153, 0.00516},
                                    {0.15346, -0.26756, 0.06670, 0.26688}}};

double ZenithChromaticity(const ZenithMatrix& m, double turbidity, double theta) {
  const auto row = [&](const std::array<double, 4>& c) {
    return ((c[0] * theta + c[1]) * theta + c[2]) * theta + c[3];
  };
  return (row(m[0]) * turbidity + row(m[1])) * turbidity + row(m[2]);
}

/// cd/m² (Preetham gives kcd/m²).
double ZenithLuminance(double turbidity, double theta) {
  const double chi = (4.0 / 9.0 - turbidity / 120.0) * (pi - 2.0 * theta);
  return 1000.0 * ((4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192);
}

double ClampedTurbidity(double turbidity) {
  if (std::isnan(turbidity)) return PerezSky::kMinTurbidity;
  return std::clamp(turbidity, PerezSky::kMinTurbidity, PerezSky::kMaxTurbidity);
}

// Cosine used at the horizon; e^(B / cos θ) is already zero there, because B < 0.
constexpr double kMinCosine = 1e-3;

}  // namespace

double PerezSky::Distribution::At(double cos_theta, double gamma, double cos_gamma) const {
  return zenith_over_f * (1.0 + a * std::exp(b / cos_theta)) *
         (1.0 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
}

PerezSky::PerezSky(double turbidity, Direction<World> to_sun)
    : turbidity_(ClampedTurbidity(turbidity)),
      turbidity_was_clamped_(!(turbidity_ == turbidity)),
      to_sun_(LiftedToHorizon(to_sun.xyz)) {
  const double cos_sun = std::min(to_sun_.z, 1.0);
  const double theta_sun = std::acos(cos_sun);
  const double elevation = std::asin(std::clamp(to_sun.xyz.z, -1.0, 1.0));
  const auto make = [&](const std::array<Linear, 5>& c, double zenith) {
    Distribution d{c[0].At(turbidity_), c[1].At(turbidity_), c[2].At(turbidity_),
                   c[3].At(turbidity_), c[4].At(turbidity_), 1.0};
    d.zenith_over_f = zenith / d.At(1.0, theta_sun, cos_sun);
    return d;
  };
  luminance_ =
      make(kLuminance, ZenithLuminance(turbidity_, theta_sun) * TwilightShare(Radians(elevation)));
  x_ = make(kChromaticityX, ZenithChromaticity(kZenithX, turbidity_, theta_sun));
  y_ = make(kChromaticityY, ZenithChromaticity(kZenithY, turbidity_, theta_sun));
}

XyY PerezSky::At(Direction<World> from) const {
  if (from.xyz.z < 0.0) return {};
  const double cos_theta = std::max(from.xyz.z, kMinCosine);
  const double cos_gamma = std::clamp(Dot(from.xyz, to_sun_), -1.0, 1.0);
  const double gamma = AngleBetween(from.xyz, to_sun_);
  return {x_.At(cos_theta, gamma, cos_gamma), y_.At(cos_theta, gamma, cos_gamma),
          luminance_.At(cos_theta, gamma, cos_gamma)};
}

LinearRgb PerezSky::HorizontalIrradiance() const {
  return IntegrateProjectedDome([this](Direction<World> from) { return Radiance(from); });
}

}  // namespace pleinair::sky
