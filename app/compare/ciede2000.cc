#include "app/compare/ciede2000.h"

#include <cmath>

#include <lcms2.h>

#include "base/srgb.h"

namespace pleinair::app {

Lab LabFromSrgb8(const std::array<std::uint8_t, 3>& rgb) {
  const std::array<float, 256>& linear = LinearFromSrgb8();
  const double r = linear[rgb[0]], g = linear[rgb[1]], b = linear[rgb[2]];
  // IEC 61966-2-1 primaries; the white is their sum.
  const double x = (0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.9504700;
  const double y = 0.2126729 * r + 0.7151522 * g + 0.0721750 * b;
  const double z = (0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.0888300;
  // CIE 15:2004, section 8.2.1.
  const auto f = [](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  };
  return {116.0 * f(y) - 16.0, 500.0 * (f(x) - f(y)), 200.0 * (f(y) - f(z))};
}

double Ciede2000(const Lab& first, const Lab& second) {
  const cmsCIELab a{first.lightness, first.a, first.b};
  const cmsCIELab b{second.lightness, second.a, second.b};
  return cmsCIE2000DeltaE(&a, &b, 1.0, 1.0, 1.0);
}

}  // namespace pleinair::app
