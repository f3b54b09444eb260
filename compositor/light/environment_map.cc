#include "compositor/light/environment_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "compositor/light/sky_table.h"

namespace pleinair::compositor {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 64;

Vec3 DirectionOfTexel(int column, int row) {
  const double azimuth = 2 * kPi * (column + 0.5) / EnvironmentMap::kWidth - kPi;
  const double polar = kPi * (row + 0.5) / EnvironmentMap::kHeight;
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar)};
}

/// Van der Corput sequence in base 2, by bit reversal (Hammersley's second coordinate).
double RadicalInverse(std::uint32_t bits) {
  bits = (bits << 16U) | (bits >> 16U);
  bits = ((bits & 0x55555555U) << 1U) | ((bits & 0xAAAAAAAAU) >> 1U);
  bits = ((bits & 0x33333333U) << 2U) | ((bits & 0xCCCCCCCCU) >> 2U);
  bits = ((bits & 0x0F0F0F0FU) << 4U) | ((bits & 0xF0F0F0F0U) >> 4U);
  bits = ((bits & 0x00FF00FFU) << 8U) | ((bits & 0xFF00FF00U) >> 8U);
  return static_cast<double>(bits) * 0x1p-32;
}

}  // namespace

EnvironmentMap BuildEnvironmentMap(const sky::SkyModel& day, const Mat3& marker_from_world,
                                   LinearRgb ground_radiance) {
  // Tabulated because hundreds of thousands of directions are sampled. The table's land is not
  // used.
  const SkyTable sky(day, marker_from_world, 0.0);
  const auto radiance = [&](Vec3 direction_in_marker) {
    if (sky.SineElevation(direction_in_marker) <= 0.0) return ground_radiance;
    const auto [r, g, b] = sky.Radiance(direction_in_marker);
    return LinearRgb{r, g, b};
  };
  EnvironmentMap map;
  for (int level = 0; level < EnvironmentMap::kLevels; ++level) {
    Image<float> picture(EnvironmentMap::kWidth, EnvironmentMap::kHeight, 3);
    const double roughness = static_cast<double>(level) / (EnvironmentMap::kLevels - 1);
    const double alpha2 = std::pow(roughness, 4);  // GGX alpha = roughness², squared.
    for (int row = 0; row < EnvironmentMap::kHeight; ++row) {
      for (int column = 0; column < EnvironmentMap::kWidth; ++column) {
        const Vec3 normal = DirectionOfTexel(column, row);
        LinearRgb sum;
        double weights = 0.0;
        if (level == 0) {
          sum = radiance(normal);
          weights = 1.0;
        } else {
          const Vec3 tangent =
              Normalized(Cross(std::fabs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, normal));
          const Vec3 bitangent = Cross(normal, tangent);
          for (int i = 0; i < kSamples; ++i) {
            const double u = (i + 0.5) / kSamples;
            const double phi = 2 * kPi * RadicalInverse(static_cast<std::uint32_t>(i));
            const double cos_half = std::sqrt((1 - u) / (1 + (alpha2 - 1) * u));
            const double sin_half = std::sqrt(std::max(0.0, 1 - cos_half * cos_half));
            const Vec3 half = tangent * (sin_half * std::cos(phi)) +
                              bitangent * (sin_half * std::sin(phi)) + normal * cos_half;
            const Vec3 light = half * (2 * cos_half) - normal;
            const double cosine = Dot(normal, light);
            if (cosine <= 0.0) continue;
            sum = sum + radiance(light) * cosine;
            weights += cosine;
          }
        }
        const LinearRgb mean = weights > 0.0 ? sum * (1.0 / weights) : radiance(normal);
        picture(column, row, 0) = static_cast<float>(mean.r);
        picture(column, row, 1) = static_cast<float>(mean.g);
        picture(column, row, 2) = static_cast<float>(mean.b);
      }
    }
    map.levels[level] = std::move(picture);
  }
  return map;
}

}  // namespace pleinair::compositor
