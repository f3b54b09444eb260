#pragma once

#include <array>
#include <cmath>

namespace pleinair {

/// Plain coordinate tuples for module boundaries. Linear algebra inside modules uses Eigen or GLM.
struct Vec2 {
  double x = 0.0, y = 0.0;
  constexpr bool operator==(const Vec2&) const = default;
  constexpr Vec2 operator+(Vec2 o) const { return {x + o.x, y + o.y}; }
  constexpr Vec2 operator-(Vec2 o) const { return {x - o.x, y - o.y}; }
  constexpr Vec2 operator*(double s) const { return {x * s, y * s}; }
};

struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;
  constexpr bool operator==(const Vec3&) const = default;
  constexpr Vec3 operator+(Vec3 o) const { return {x + o.x, y + o.y, z + o.z}; }
  constexpr Vec3 operator-(Vec3 o) const { return {x - o.x, y - o.y, z - o.z}; }
  constexpr Vec3 operator-() const { return {-x, -y, -z}; }
  constexpr Vec3 operator*(double s) const { return {x * s, y * s, z * s}; }
};

constexpr double Dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 Cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double Norm(Vec2 a) { return std::hypot(a.x, a.y); }
inline double Norm(Vec3 a) { return std::sqrt(Dot(a, a)); }
inline Vec3 Normalized(Vec3 a) { return a * (1.0 / Norm(a)); }

/// 3×3 matrix, row-major.
struct Mat3 {
  std::array<double, 9> m{1, 0, 0, 0, 1, 0, 0, 0, 1};
  constexpr bool operator==(const Mat3&) const = default;
  constexpr double operator()(int row, int column) const { return m[row * 3 + column]; }
  constexpr double& operator()(int row, int column) { return m[row * 3 + column]; }
  constexpr Vec3 operator*(Vec3 v) const {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
  }
  constexpr Mat3 operator*(const Mat3& o) const {
    Mat3 product;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        product(r, c) = (*this)(r, 0) * o(0, c) + (*this)(r, 1) * o(1, c) + (*this)(r, 2) * o(2, c);
      }
    }
    return product;
  }
  constexpr Mat3 Transposed() const {
    return {{m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]}};
  }
};

/// Color or light in linear sRGB/Rec.709 primaries; the variable that holds it defines the unit.
struct LinearRgb {
  double r = 0.0, g = 0.0, b = 0.0;
  constexpr bool operator==(const LinearRgb&) const = default;
  constexpr LinearRgb operator+(LinearRgb o) const { return {r + o.r, g + o.g, b + o.b}; }
  constexpr LinearRgb operator*(LinearRgb o) const { return {r * o.r, g * o.g, b * o.b}; }
  constexpr LinearRgb operator*(double s) const { return {r * s, g * s, b * s}; }
  constexpr LinearRgb operator/(LinearRgb o) const { return {r / o.r, g / o.g, b / o.b}; }
};

/// Relative luminance of linear Rec.709 primaries (IEC 61966-2-1: Y row of the RGB→XYZ matrix).
constexpr double Luminance(LinearRgb c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

/// Mean natural logarithm of the three channels, a measure of brightness ratios. All channels must
/// be above 0.
inline double MeanLog(LinearRgb c) { return (std::log(c.r) + std::log(c.g) + std::log(c.b)) / 3; }

}  // namespace pleinair
