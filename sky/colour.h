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

/// Brings a colour outside Rec.709's gamut into it: no negative channel, and the luminance stays.
inline LinearRgb ClipToGamut(LinearRgb colour) {
  const double luminance = Luminance(colour);
  if (luminance <= 0.0) return {};
  const LinearRgb clipped{std::max(colour.r, 0.0), std::max(colour.g, 0.0),
                          std::max(colour.b, 0.0)};
  return clipped * (luminance / Luminance(clipped));
}

/// Linear Rec.709 whose Luminance() is exactly `colour.luminance`.
inline LinearRgb RgbFromXyY(const XyY& colour) {
  if (colour.luminance <= 0.0 || colour.y <= 0.0) return {};
  const LinearRgb relative =
      ClipToGamut(RgbFromXyz(colour.x / colour.y, 1.0, (1.0 - colour.x - colour.y) / colour.y));
  const double luminance = Luminance(relative);
  return luminance > 0.0 ? relative * (colour.luminance / luminance) : LinearRgb{};
}

}  // namespace pleinair::sky
