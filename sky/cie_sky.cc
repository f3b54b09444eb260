#include "sky/cie_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/check.h"
#include "sky/sun/sun_direction.h"

namespace pleinair::sky {
namespace {

constexpr std::array<CieParameters, CieSky::kTypes> kTable = {{
    {4.0, -0.70, 0.0, -1.0, 0.00},    // 1 overcast, steep gradation
    {4.0, -0.70, 2.0, -1.5, 0.15},    // 2 overcast, steep, brighter towards the sun
    {1.1, -0.80, 0.0, -1.0, 0.00},    // 3 overcast, moderate gradation
    {1.1, -0.80, 2.0, -1.5, 0.15},    // 4 overcast, moderate, brighter towards the sun
    {0.0, -1.00, 0.0, -1.0, 0.00},    // 5 uniform
    {0.0, -1.00, 2.0, -1.5, 0.15},    // 6 partly cloudy, slightly brighter towards the sun
    {0.0, -1.00, 5.0, -2.5, 0.30},    // 7 partly cloudy, brighter circumsolar region
    {0.0, -1.00, 10.0, -3.0, 0.45},   // 8 partly cloudy, distinct corona
    {-1.0, -0.55, 2.0, -1.5, 0.15},   // 9 partly cloudy, obscured sun
    {-1.0, -0.55, 5.0, -2.5, 0.30},   // 10 partly cloudy, brighter circumsolar region
    {-1.0, -0.55, 10.0, -3.0, 0.45},  // 11 white-blue, distinct corona
    {-1.0, -0.32, 10.0, -3.0, 0.45},  // 12 clear, low turbidity
    {-1.0, -0.32, 16.0, -3.0, 0.30},  // 13 clear, polluted
    {-1.0, -0.15, 16.0, -3.0, 0.30},  // 14 cloudless turbid, broad corona
    {-1.0, -0.15, 24.0, -2.8, 0.15},  // 15 white-blue turbid, broad corona
}};

// Cosine used at the horizon. Every b is negative, so e^(b / cos Z) is already zero there.
constexpr double kMinCosine = 1e-3;

}  // namespace

CieParameters CieParametersOfType(int type) {
  CHECK_GE(type, 1);
  CHECK_LE(type, CieSky::kTypes);
  return kTable[static_cast<std::size_t>(type) - 1];
}

CieSky::CieSky(int type, Direction<World> to_sun)
    : p_(CieParametersOfType(type)),
      to_sun_(LiftedToHorizon(to_sun.xyz)),
      horizon_term_(1.0 - p_.c * std::exp(p_.d * std::numbers::pi / 2.0)) {
  const double zenith_distance = AngleBetween(to_sun_, {0.0, 0.0, 1.0});
  scale_ = 1.0 / (Indicatrix(zenith_distance, to_sun_.z) * (1.0 + p_.a * std::exp(p_.b)));
  illuminance_over_zenith_ = IntegrateIlluminance(zenith_distance);
}

double CieSky::IntegrateIlluminance(double sun_zenith_distance) const {
  // Integrates half of the symmetric dome, in two parts that meet at the sun's elevation. The Gauss
  // nodes (two per interval) are densest near the sun, where the aureole has a peak.
  constexpr int kNodes = 64;
  const auto node = [](int i) {
    const double within = i % 2 == 0 ? 0.5 - std::sqrt(1.0 / 12.0) : 0.5 + std::sqrt(1.0 / 12.0);
    const int interval = i / 2;
    return (interval + within) * 2.0 / kNodes;
  };
  std::array<double, kNodes> cosines{}, weights{};
  for (int i = 0; i < kNodes; ++i) {
    const double u = node(i);
    cosines[i] = std::cos(std::numbers::pi * u * u);
    weights[i] = 2.0 * std::numbers::pi * u / kNodes;
  }
  const double sun_up = std::cos(sun_zenith_distance), sun_level = std::sin(sun_zenith_distance);
  double sum = 0.0;
  for (const double span : {-sun_zenith_distance, 0.5 * std::numbers::pi - sun_zenith_distance}) {
    for (int i = 0; i < kNodes; ++i) {
      const double t = node(i);
      const double z = sun_zenith_distance + span * t * t;
      const double up = std::cos(z), level = std::sin(z);
      double ring = 0.0;
      for (int j = 0; j < kNodes; ++j) {
        const double cos_chi = std::min(1.0, up * sun_up + level * sun_level * cosines[j]);
        ring += weights[j] * Indicatrix(std::acos(cos_chi), cos_chi);
      }
      sum += ring * Gradation(up) * up * level * 2.0 * t * std::fabs(span) / kNodes;
    }
  }
  return 2.0 * scale_ * sum;
}

double CieSky::Gradation(double up) const {
  return 1.0 + p_.a * std::exp(p_.b / std::max(up, kMinCosine));
}

double CieSky::Indicatrix(double chi, double cos_chi) const {
  return horizon_term_ + p_.c * std::exp(p_.d * chi) + p_.e * cos_chi * cos_chi;
}

double CieSky::RelativeLuminance(Direction<World> from) const {
  if (from.xyz.z < 0.0) return 0.0;
  const double cos_chi = std::clamp(Dot(from.xyz, to_sun_), -1.0, 1.0);
  return scale_ * Gradation(from.xyz.z) * Indicatrix(AngleBetween(from.xyz, to_sun_), cos_chi);
}

}  // namespace pleinair::sky
