#include "app/compare/ciede2000.h"

#include <cmath>

#include "base/srgb.h"
#include "base/units.h"

namespace pleinair::app {
namespace {

double Cosine(double degrees) { return std::cos(degrees * kRadiansPerDegree); }

/// √(C⁷ / (C⁷ + 25⁷)), of Eqs. 4 and 16.
double ChromaShare(double chroma) {
  const double seventh = std::pow(chroma, 7);
  return std::sqrt(seventh / (seventh + std::pow(25.0, 7)));
}

/// Hue angle in degrees, 0…360; 0 where there is no hue (Eq. 7).
double Hue(double a, double b) {
  if (a == 0.0 && b == 0.0) return 0.0;
  const double hue = std::atan2(b, a) / kRadiansPerDegree;
  return hue < 0.0 ? hue + 360.0 : hue;
}

}  // namespace

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
  // Eqs. 2 to 7.
  const double mean_chroma = 0.5 * (std::hypot(first.a, first.b) + std::hypot(second.a, second.b));
  const double stretch = 1.0 + 0.5 * (1.0 - ChromaShare(mean_chroma));
  const double a1 = stretch * first.a, a2 = stretch * second.a;
  const double c1 = std::hypot(a1, first.b), c2 = std::hypot(a2, second.b);
  const double h1 = Hue(a1, first.b), h2 = Hue(a2, second.b);
  const bool without_hue = c1 * c2 == 0.0;

  // Eqs. 8 to 11.
  const double lightness_step = second.lightness - first.lightness;
  const double chroma_step = c2 - c1;
  double turn = without_hue ? 0.0 : h2 - h1;
  if (turn > 180.0) turn -= 360.0;
  if (turn < -180.0) turn += 360.0;
  const double hue_step = 2.0 * std::sqrt(c1 * c2) * std::sin(0.5 * turn * kRadiansPerDegree);

  // Eqs. 12 to 14.
  const double lightness = 0.5 * (first.lightness + second.lightness);
  const double chroma = 0.5 * (c1 + c2);
  double hue = h1 + h2;
  if (!without_hue) {
    if (std::abs(h1 - h2) > 180.0) hue += hue < 360.0 ? 360.0 : -360.0;
    hue *= 0.5;
  }

  // Eqs. 15 to 21.
  const double t = 1.0 - 0.17 * Cosine(hue - 30.0) + 0.24 * Cosine(2.0 * hue) +
                   0.32 * Cosine(3.0 * hue + 6.0) - 0.20 * Cosine(4.0 * hue - 63.0);
  const double offset = (lightness - 50.0) * (lightness - 50.0);
  const double lightness_weight = 1.0 + 0.015 * offset / std::sqrt(20.0 + offset);
  const double chroma_weight = 1.0 + 0.045 * chroma;
  const double hue_weight = 1.0 + 0.015 * chroma * t;
  const double blue = (hue - 275.0) / 25.0;
  const double rotation =
      -2.0 * ChromaShare(chroma) * std::sin(60.0 * std::exp(-blue * blue) * kRadiansPerDegree);

  // Eq. 22.
  const double l = lightness_step / lightness_weight;
  const double c = chroma_step / chroma_weight;
  const double h = hue_step / hue_weight;
  return std::sqrt(l * l + c * c + h * h + rotation * c * h);
}

}  // namespace pleinair::app
