#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "sky/cloud_cover.h"

namespace pleinair::sky {

/// A direction at random, evenly over the sphere above `lowest_z`.
inline Vec3 RandomDirection(std::mt19937_64& random, double lowest_z) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double z = lowest_z + (1.0 - lowest_z) * unit(random);
  const double azimuth = 2.0 * M_PI * unit(random);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::sin(azimuth), r * std::cos(azimuth), z};
}

/// The direction as a shader gets it.
inline Vec3 RoundedToFloat(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Directions of the dome to compare twins in; one in ten within 3° of the sun, where digits are
/// lost most easily.
inline std::vector<Vec3> DirectionsAbout(Vec3 to_sun, int count, std::mt19937_64& random) {
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i) {
    Vec3 direction = RandomDirection(random, 0.0);
    if (i % 10 == 0 && to_sun.z > 0.1) direction = Normalized(to_sun + direction * 0.05);
    directions.push_back(RoundedToFloat(direction));
  }
  return directions;
}

/// Largest difference of a channel, relative to the brightest: a channel close to zero has no
/// relative accuracy.
inline double RelativeDifference(LinearRgb expected, double r, double g, double b) {
  const double scale = std::max({expected.r, expected.g, expected.b});
  const double worst =
      std::max({std::fabs(r - expected.r), std::fabs(g - expected.g), std::fabs(b - expected.b)});
  return scale > 0.0 ? worst / scale : worst;
}

/// A cloudy sky as both languages get it: numbers that floats hold.
struct CloudCase {
  double cover;
  Vec3 to_sun;
  LinearRgb clear_sky, clear_sun;  ///< Lux.

  Clouds Create() const { return {cover, {to_sun}, clear_sky, clear_sun}; }
};

inline CloudCase RandomCloudCase(std::mt19937_64& random, int i) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double sky = static_cast<float>(20'000.0 * unit(random));
  const double sun = static_cast<float>(100'000.0 * unit(random));
  // The edges of the patterns among them.
  const double cover = i % 5 == 0 ? (i / 5 % 4) / 3.0 : unit(random);
  return {static_cast<float>(cover),
          RoundedToFloat(RandomDirection(random, -0.1)),
          {sky, sky, sky},
          {sun, sun, sun}};
}

/// The clear sky's radiance in a direction, for the clouds to lie before.
inline LinearRgb ClearBehindClouds(Vec3 direction) {
  return {1'500.0, 2'000.0, static_cast<float>(3'000.0 + 4'000.0 * direction.z)};
}

}  // namespace pleinair::sky
