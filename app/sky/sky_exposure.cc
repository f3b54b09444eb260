#include "app/sky/sky_exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/srgb.h"
#include "base/vector.h"

namespace pleinair::app {
namespace {

constexpr double kSaturation = 1.2;  // Luminance · t / (N² ) constant of ISO 12232 at EV 0.
constexpr double kWhite = 8.0;
// The key is meant for a whole scene with land and shadows; the sky is its bright part.
constexpr double kSkyInScene = 0.7;
constexpr double kDarkest_cd_m2 = 0.005;  // Limit of cone vision (CIE 191:2010).

/// Maps linear values to 8-bit sRGB values, in steps fine enough for eight bits.
class SrgbTable {
 public:
  SrgbTable() {
    for (std::size_t i = 0; i < codes_.size(); ++i) {
      codes_[i] = Srgb8FromLinear(static_cast<double>(i) / (codes_.size() - 1));
    }
  }
  std::uint8_t operator()(double linear) const {
    const double at = std::clamp(linear, 0.0, 1.0) * static_cast<double>(codes_.size() - 1);
    return codes_[static_cast<std::size_t>(std::lround(at))];
  }

 private:
  // At the curve's steepest part, one 8-bit value is 1 / (255 · 12.92) wide.
  std::array<std::uint8_t, 1 << 14> codes_{};
};

}  // namespace

double SkyExposure::Ev100() const { return std::log2(1.0 / (kSaturation * exposure_scale)); }

SkyExposure ExposureOf(double ev100) { return {1.0 / (kSaturation * std::exp2(ev100))}; }

SkyExposure AutomaticExposure(Lux sky_horizontal) {
  const double mean = std::max(sky_horizontal.value() / std::numbers::pi, kDarkest_cd_m2);
  const double key = 1.03 - 2.0 / (2.0 + std::log10(mean + 1.0));
  return {kSkyInScene * key / mean};
}

RgbImage ToneMap(const LightImage& light, SkyExposure exposure) {
  static const SrgbTable kCodes;
  RgbImage picture(light.width(), light.height(), 3);
  for (std::size_t i = 0; i < light.size(); i += 3) {
    const LinearRgb radiance{light.data()[i], light.data()[i + 1], light.data()[i + 2]};
    const double luminance = Luminance(radiance);
    LinearRgb shown;
    if (luminance > 0.0) {
      const double v = exposure.exposure_scale * luminance;
      const double grey = std::min(1.0, v * (1.0 + v / (kWhite * kWhite)) / (1.0 + v));
      const LinearRgb color = radiance * (grey / luminance);
      const double highest = std::max({color.r, color.g, color.b});
      const double kept = highest > 1.0 ? (1.0 - grey) / (highest - grey) : 1.0;
      shown = LinearRgb{grey, grey, grey} * (1.0 - kept) + color * kept;
    }
    picture.data()[i] = kCodes(shown.r);
    picture.data()[i + 1] = kCodes(shown.g);
    picture.data()[i + 2] = kCodes(shown.b);
  }
  return picture;
}

}  // namespace pleinair::app
