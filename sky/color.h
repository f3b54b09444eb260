#pragma once

#include <algorithm>

#include "base/vector.h"

namespace pleinair::sky {

/// Luminance in cd/m² (or illuminance in lux) with CIE 1931 chromaticity.
struct XyY {
  double x = 0.0, y = 0.0, luminance = 0.0;
};

/// CIE XYZ to linear Rec.709 primaries, D65 (IEC 61966-2-1, Annex F). May give negative channels.
constexpr LinearRgb RgbFromXyz(double x, double y, double z) {
  return {3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z,
          0.0557 * x - 0.2040 * y + 1.0570 * z};
}

/// Linear Rec.709 primaries, D65, to CIE XYZ (IEC 61966-2-1, Annex F), in {x, y, z}.
constexpr Vec3 XyzFromRgb(LinearRgb c) {
  return {0.4124 * c.r + 0.3576 * c.g + 0.1805 * c.b, Luminance(c),
          0.0193 * c.r + 0.1192 * c.g + 0.9505 * c.b};
}

/// Chromaticity and luminance of XYZ; D65's chromaticity for black.
constexpr XyY XyYFromXyz(Vec3 xyz) {
  const double sum = xyz.x + xyz.y + xyz.z;
  if (sum <= 0.0) return {0.3127, 0.3290, 0.0};
  return {xyz.x / sum, xyz.y / sum, xyz.y};
}
constexpr Vec3 XyzFromXyY(const XyY& c) {
  if (c.y <= 0.0) return {};
  return {c.luminance * c.x / c.y, c.luminance, c.luminance * (1.0 - c.x - c.y) / c.y};
}
constexpr XyY XyYFromRgb(LinearRgb color) { return XyYFromXyz(XyzFromRgb(color)); }

/// Moves a color outside Rec.709's gamut into it: no negative channel, same luminance.
inline LinearRgb ClipToGamut(LinearRgb color) {
  const double luminance = Luminance(color);
  if (luminance <= 0.0) return {};
  const LinearRgb clipped{std::max(color.r, 0.0), std::max(color.g, 0.0), std::max(color.b, 0.0)};
  return clipped * (luminance / Luminance(clipped));
}

/// As ClipToGamut(), from CIE XYZ: linear Rec.709 without a negative channel whose Luminance() is
/// Y.
inline LinearRgb RgbInGamut(Vec3 xyz) {
  if (xyz.y <= 0.0) return {};
  const LinearRgb c = RgbFromXyz(xyz.x, xyz.y, xyz.z);
  const LinearRgb clipped{std::max(c.r, 0.0), std::max(c.g, 0.0), std::max(c.b, 0.0)};
  const double luminance = Luminance(clipped);
  return luminance > 0.0 ? clipped * (xyz.y / luminance) : LinearRgb{};
}

/// Linear Rec.709 whose Luminance() is exactly `color.luminance`.
inline LinearRgb RgbFromXyY(const XyY& color) {
  if (color.luminance <= 0.0 || color.y <= 0.0) return {};
  const LinearRgb relative =
      ClipToGamut(RgbFromXyz(color.x / color.y, 1.0, (1.0 - color.x - color.y) / color.y));
  const double luminance = Luminance(relative);
  return luminance > 0.0 ? relative * (color.luminance / luminance) : LinearRgb{};
}

}  // namespace pleinair::sky
