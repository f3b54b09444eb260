#include "sky/daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sky/dome.h"
#include "sky/perez.h"
#include "sky/standard_illuminance.h"
#include "sky/sunlight_spectrum.h"

namespace pleinair::sky {
namespace {

/// A colour of given luminance.
LinearRgb WithLuminance(LinearRgb colour, Lux luminance) {
  const double now = Luminance(colour);
  return now > 0.0 ? colour * (luminance.value() / now) : LinearRgb{};
}

/// Clear, hazy or partly cloudy: a scaled PerezSky, an even veil of clouds, the sun.
class PerezDaylight : public SkyModel {
 public:
  PerezDaylight(const SunPosition& sun, SkyCondition condition, double turbidity)
      : to_sun_(sun.ToSun()), perez_(turbidity, to_sun_) {
    const StandardIlluminance light = ComputeStandardIlluminance(
        condition, perez_.turbidity(), sun.elevation_refracted, sun.distance_au);
    sun_normal_ = WithLuminance(
        DirectSunIrradiance(perez_.turbidity(), sun.elevation_refracted, sun.distance_au),
        light.sun_normal);

    double blue_lux = light.sky_horizontal.value();
    if (condition == SkyCondition::kPartlyCloudy) {
      const StandardIlluminance clear = ComputeStandardIlluminance(
          SkyCondition::kClear, perez_.turbidity(), sun.elevation_refracted, sun.distance_au);
      blue_lux = 0.5 * std::min(blue_lux, clear.sky_horizontal.value());
    }
    const double cloud_lux = light.sky_horizontal.value() - blue_lux;
    cloud_radiance_ = cloud_lux / std::numbers::pi;
    const LinearRgb unscaled = perez_.HorizontalIrradiance();
    perez_scale_ = blue_lux / Luminance(unscaled);
    sky_horizontal_ = unscaled * perez_scale_ + LinearRgb{cloud_lux, cloud_lux, cloud_lux};
  }

  LinearRgb SkyRadiance(Direction<World> from) const override {
    if (from.xyz.z < 0.0) return {};
    return perez_.Radiance(from) * perez_scale_ +
           LinearRgb{cloud_radiance_, cloud_radiance_, cloud_radiance_};
  }
  LinearRgb SunNormalIrradiance() const override { return sun_normal_; }
  LinearRgb SkyHorizontalIrradiance() const override { return sky_horizontal_; }
  Direction<World> ToSun() const override { return to_sun_; }

 private:
  Direction<World> to_sun_;
  PerezSky perez_;
  double perez_scale_ = 0.0;
  double cloud_radiance_ = 0.0;  ///< cd/m².
  LinearRgb sun_normal_;
  LinearRgb sky_horizontal_;
};

class OvercastDaylight : public SkyModel {
 public:
  explicit OvercastDaylight(const SunPosition& sun) : to_sun_(sun.ToSun()) {
    horizontal_lux_ = ComputeStandardIlluminance(SkyCondition::kOvercast, 0.0,
                                                 sun.elevation_refracted, sun.distance_au)
                          .sky_horizontal.value();
    const double unscaled =
        IntegrateProjectedDome([](Direction<World> from) { return Gradation(from.xyz.z); });
    scale_ = horizontal_lux_ / unscaled;
  }

  LinearRgb SkyRadiance(Direction<World> from) const override {
    if (from.xyz.z < 0.0) return {};
    const double luminance = scale_ * Gradation(from.xyz.z);
    return {luminance, luminance, luminance};
  }
  LinearRgb SunNormalIrradiance() const override { return {}; }
  LinearRgb SkyHorizontalIrradiance() const override {
    return {horizontal_lux_, horizontal_lux_, horizontal_lux_};
  }
  Direction<World> ToSun() const override { return to_sun_; }

 private:
  /// ISO 15469:2004, type 1: a = 4.0, b = −0.70, no indicatrix.
  static double Gradation(double cos_theta) {
    return 1.0 + 4.0 * std::exp(-0.70 / std::max(cos_theta, 1e-3));
  }

  Direction<World> to_sun_;
  double horizontal_lux_ = 0.0;
  double scale_ = 0.0;
};

}  // namespace

std::unique_ptr<SkyModel> CreateDaylight(const SunPosition& sun, const DaylightOptions& options) {
  if (options.condition == SkyCondition::kOvercast) return std::make_unique<OvercastDaylight>(sun);
  const double turbidity =
      options.turbidity == 0.0 ? DefaultTurbidity(options.condition) : options.turbidity;
  return std::make_unique<PerezDaylight>(sun, options.condition, turbidity);
}

}  // namespace pleinair::sky
