#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pleinair {

// sRGB transfer function (IEC 61966-2-1:1999). Light is linear inside pleinair; these functions
// convert where 8-bit images are read and written.

/// Linear light (0…1) of an encoded value (0…1).
inline double LinearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Encoded value (0…1) of linear light; clamps to 0…1.
inline double SrgbFromLinear(double linear) {
  const double clipped = std::clamp(linear, 0.0, 1.0);
  return clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * std::pow(clipped, 1.0 / 2.4) - 0.055;
}

/// Nearest 8-bit pixel value of linear light.
inline std::uint8_t Srgb8FromLinear(double linear) {
  return static_cast<std::uint8_t>(std::lround(SrgbFromLinear(linear) * 255.0));
}

/// Linear light of all 256 pixel values.
inline const std::array<float, 256>& LinearFromSrgb8() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (int i = 0; i < 256; ++i) values[i] = static_cast<float>(LinearFromSrgb(i / 255.0));
    return values;
  }();
  return table;
}

}  // namespace pleinair
