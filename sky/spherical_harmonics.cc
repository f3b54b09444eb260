#include "sky/spherical_harmonics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::sky {
namespace {

using std::numbers::pi;

/// Ramamoorthi & Hanrahan 2001, Eq. (3).
std::array<double, 9> Basis(Vec3 n) {
  return {0.282095,
          0.488603 * n.y,
          0.488603 * n.z,
          0.488603 * n.x,
          1.092548 * n.x * n.y,
          1.092548 * n.y * n.z,
          0.315392 * (3.0 * n.z * n.z - 1.0),
          1.092548 * n.x * n.z,
          0.546274 * (n.x * n.x - n.y * n.y)};
}

// Their Eq. (8): the clamped cosine in the order of the basis.
constexpr double kBand0 = pi;
constexpr double kBand1 = 2.0 * pi / 3.0;
constexpr double kBand2 = pi / 4.0;
constexpr std::array<double, 9> kCosineLobe = {kBand0, kBand1, kBand1, kBand1, kBand2,
                                               kBand2, kBand2, kBand2, kBand2};

}  // namespace

SkyHarmonics ProjectSky(const SkyModel& model) {
  constexpr int kRings = 64;
  constexpr int kSectors = 128;
  SkyHarmonics sky;
  for (int ring = 0; ring < kRings; ++ring) {
    const double up = (ring + 0.5) / kRings;  // Rings of equal solid angle.
    const double horizontal = std::sqrt(1.0 - up * up);
    for (int sector = 0; sector < kSectors; ++sector) {
      const double azimuth = 2.0 * pi * (sector + 0.5) / kSectors;
      const Vec3 direction{horizontal * std::sin(azimuth), horizontal * std::cos(azimuth), up};
      const LinearRgb radiance = model.SkyRadiance({direction});
      const std::array<double, 9> basis = Basis(direction);
      for (std::size_t i = 0; i < basis.size(); ++i) {
        sky.radiance[i] = sky.radiance[i] + radiance * basis[i];
      }
    }
  }
  for (LinearRgb& coefficient : sky.radiance) {
    coefficient = coefficient * (2.0 * pi / (kRings * kSectors));
  }
  return sky;
}

LinearRgb SkyHarmonics::Irradiance(Direction<World> normal) const {
  const std::array<double, 9> basis = Basis(normal.xyz);
  LinearRgb sum;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    sum = sum + radiance[i] * (kCosineLobe[i] * basis[i]);
  }
  return {std::max(sum.r, 0.0), std::max(sum.g, 0.0), std::max(sum.b, 0.0)};
}

}  // namespace pleinair::sky
