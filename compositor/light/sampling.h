#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/vector.h"

namespace pleinair::compositor {

/// Two numbers in [0, 1).
struct SamplePoint {
  double u = 0.0, v = 0.0;
};

/// A well-mixed 32-bit hash of two numbers (the finaliser of MurmurHash3).
inline std::uint32_t Hash(std::uint32_t a, std::uint32_t b) {
  std::uint32_t h = a * 0x9E3779B9U + b;
  h ^= h >> 16;
  h *= 0x85EBCA6BU;
  h ^= h >> 13;
  h *= 0xC2B2AE35U;
  h ^= h >> 16;
  return h;
}

/// Maps a hash to [0, 1).
inline double UnitFromHash(std::uint32_t hash) { return hash * 0x1p-32; }

/// Point `i` of `count` of Hammersley's set (base 2).
inline SamplePoint Hammersley(std::uint32_t i, std::uint32_t count) {
  std::uint32_t reversed = (i << 16) | (i >> 16);
  reversed = ((reversed & 0x00FF00FFU) << 8) | ((reversed & 0xFF00FF00U) >> 8);
  reversed = ((reversed & 0x0F0F0F0FU) << 4) | ((reversed & 0xF0F0F0F0U) >> 4);
  reversed = ((reversed & 0x33333333U) << 2) | ((reversed & 0xCCCCCCCCU) >> 2);
  reversed = ((reversed & 0x55555555U) << 1) | ((reversed & 0xAAAAAAAAU) >> 1);
  return {(i + 0.5) / count, reversed * 0x1p-32};
}

/// The shift of ShiftedHammersley() by a seed.
inline SamplePoint HammersleyShift(std::uint32_t seed) {
  return {UnitFromHash(Hash(seed, 0x51U)), UnitFromHash(Hash(seed, 0xA7U))};
}

/// Point `i` of `count` of Hammersley's set, shifted around the unit square by an amount that
/// depends on `seed` (Cranley & Patterson 1976). Equal seeds give equal points.
inline SamplePoint ShiftedHammersley(std::uint32_t i, std::uint32_t count, std::uint32_t seed) {
  const SamplePoint at = Hammersley(i, count), shift = HammersleyShift(seed);
  SamplePoint point{at.u + shift.u, at.v + shift.v};
  if (point.u >= 1.0) point.u -= 1.0;
  if (point.v >= 1.0) point.v -= 1.0;
  return point;
}

/// Two unit vectors, orthogonal to the unit vector `n` and to each other. Duff et al. 2017,
/// "Building an Orthonormal Basis, Revisited", listing 3.
struct TangentFrame {
  Vec3 tangent, bitangent, normal;
  explicit TangentFrame(Vec3 n) : normal(n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    tangent = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
  }
  Vec3 ToWorld(double x, double y, double z) const {
    return tangent * x + bitangent * y + normal * z;
  }
};

/// Direction about the frame's normal with density cosine/π.
inline Vec3 CosineDirection(const TangentFrame& frame, SamplePoint point) {
  const double radius = std::sqrt(point.u);
  const double phi = 2.0 * std::numbers::pi * point.v;
  return frame.ToWorld(radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1.0 - point.u));
}

/// Angular radius of the sun at 1 astronomical unit: 959.63″.
inline constexpr double kSunAngularRadius = 959.63 / 3600.0 * std::numbers::pi / 180.0;

/// Direction to a point of the sun's disc, uniformly distributed.
inline Vec3 SunDiscDirection(const TangentFrame& to_sun, SamplePoint point) {
  const double radius = std::tan(kSunAngularRadius) * std::sqrt(point.u);
  const double phi = 2.0 * std::numbers::pi * point.v;
  return Normalized(to_sun.ToWorld(radius * std::cos(phi), radius * std::sin(phi), 1.0));
}

}  // namespace pleinair::compositor
