#pragma once

#include <array>
#include <cstdint>

namespace pleinair::app {

/// CIE 1976 L*a*b*.
struct Lab {
  double lightness = 0.0;
  double a = 0.0;
  double b = 0.0;
};

/// Converts an 8-bit sRGB pixel in the order red, green, blue; white (255, 255, 255) has L* = 100.
Lab LabFromSrgb8(const std::array<std::uint8_t, 3>& rgb);

/// Color difference CIEDE2000 with kL = kC = kH = 1, by Little CMS. A value of about 1 is just
/// noticeable side by side.
/// Sharma, Wu & Dalal, "The CIEDE2000 Color-Difference Formula: Implementation Notes, Supplementary
/// Test Data, and Mathematical Observations", Color Research and Application 30(1), 2005.
double Ciede2000(const Lab& first, const Lab& second);

}  // namespace pleinair::app
