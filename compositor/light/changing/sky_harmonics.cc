#include "compositor/light/changing/sky_harmonics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace pleinair::compositor {
namespace {

// Directions of the projection, equal in solid angle: bands of height and steps around.
constexpr int kBands = 64, kSteps = 128;

/// Real spherical harmonics of a unit vector, l = 0…2.
std::array<double, 9> HarmonicsOf(Vec3 d) {
  return {0.282094791773878,
          0.488602511902920 * d.y,
          0.488602511902920 * d.z,
          0.488602511902920 * d.x,
          1.092548430592079 * d.x * d.y,
          1.092548430592079 * d.y * d.z,
          0.315391565252520 * (3.0 * d.z * d.z - 1.0),
          1.092548430592079 * d.x * d.z,
          0.546274215296040 * (d.x * d.x - d.y * d.y)};
}

}  // namespace

SkyHarmonics::SkyHarmonics(const SkyTable& sky) {
  constexpr double kSolidAngle = 4.0 * std::numbers::pi / (kBands * kSteps);
  const Vec3 up{sky.SineElevation({1, 0, 0}), sky.SineElevation({0, 1, 0}),
                sky.SineElevation({0, 0, 1})};
  for (int band = 0; band < kBands; ++band) {
    const double z = 1.0 - 2.0 * (band + 0.5) / kBands;
    const double radius = std::sqrt(1.0 - z * z);
    for (int step = 0; step < kSteps; ++step) {
      const double turn = 2.0 * std::numbers::pi * (step + 0.5) / kSteps;
      const Vec3 direction{radius * std::cos(turn), radius * std::sin(turn), z};
      const double sine = Dot(up, direction);
      const auto radiance = sky.Radiance(sine < 0.0 ? direction - up * (2.0 * sine) : direction);
      const std::array<double, 9> harmonics = HarmonicsOf(direction);
      for (std::size_t i = 0; i < harmonics.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
          coefficients_[i][c] += kSolidAngle * harmonics[i] * radiance[c];
        }
      }
    }
  }
}

std::array<float, 3> SkyHarmonics::Irradiance(Vec3 bent, double openness) const {
  constexpr double kPi = std::numbers::pi;
  const double open = std::clamp(openness, 0.0, 1.0);
  const double c2 = 1.0 - open, c = std::sqrt(c2);
  const std::array<double, 3> bands{kPi * open, 2.0 * kPi * (1.0 - c * c2) / 3.0,
                                    kPi * open * (1.0 + 3.0 * c2) / 4.0};
  const std::array<double, 9> harmonics = HarmonicsOf(bent);
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < harmonics.size(); ++i) {
    const double weight = bands[i == 0 ? 0 : i < 4 ? 1 : 2] * harmonics[i];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * coefficients_[i][k];
  }
  return {static_cast<float>(std::max(0.0, sum[0])), static_cast<float>(std::max(0.0, sum[1])),
          static_cast<float>(std::max(0.0, sum[2]))};
}

}  // namespace pleinair::compositor
