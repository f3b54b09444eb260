#include <cmath>
#include <cstdio>

#include "sky/perez.h"
#include "sky/sky_sources.h"
#include "sky/sun/solar_disc.h"
#include "sky/sunlight_spectrum.h"

namespace pleinair::sky::internal {
namespace {

class PerezModel : public SkyModel {
 public:
  PerezModel(double turbidity, Direction<World> to_sun, double distance_au)
      : requested_turbidity_(turbidity), to_sun_(to_sun), perez_(turbidity, to_sun) {
    const Radians elevation(std::asin(std::clamp(to_sun.xyz.z, -1.0, 1.0)));
    const double closeness = 1.0 / (distance_au * distance_au);
    scale_ = closeness;
    sun_normal_ = DirectSunIrradiance(perez_.turbidity(), elevation, distance_au) *
                  DiscShareAboveHorizon(elevation);
    sky_horizontal_ = perez_.HorizontalIrradiance() * scale_;
  }

  LinearRgb SkyRadiance(Direction<World> from) const override {
    return perez_.Radiance(from) * scale_;
  }
  XyY At(Direction<World> from) const override {
    XyY color = perez_.At(from);
    color.luminance *= scale_;
    return color;
  }
  LinearRgb SunNormalIrradiance() const override { return sun_normal_; }
  LinearRgb SkyHorizontalIrradiance() const override { return sky_horizontal_; }
  Direction<World> ToSun() const override { return to_sun_; }

  std::vector<std::string> Notes() const override {
    if (!perez_.TurbidityWasClamped()) return {};
    char text[160];
    std::snprintf(
        text, sizeof text, "turbidity %g is outside the range of perez, %g to %g; %g was used",
        requested_turbidity_, PerezSky::kMinTurbidity, PerezSky::kMaxTurbidity, perez_.turbidity());
    return {text};
  }

 private:
  double requested_turbidity_;
  Direction<World> to_sun_;
  PerezSky perez_;
  double scale_ = 1.0;  ///< Preetham's sun is at 1 au.
  LinearRgb sun_normal_;
  LinearRgb sky_horizontal_;
};

class PerezSource : public SkySource {
 public:
  explicit PerezSource(double turbidity) : turbidity_(turbidity) {}
  std::unique_ptr<SkyModel> ForSun(Direction<World> to_sun, double distance_au) const override {
    return std::make_unique<PerezModel>(turbidity_, to_sun, distance_au);
  }

 private:
  double turbidity_;
};

}  // namespace

std::shared_ptr<const SkySource> MakePerezSource(const SkyConditions& conditions) {
  return std::make_shared<PerezSource>(conditions.turbidity.value_or(PerezSky::kDefaultTurbidity));
}

}  // namespace pleinair::sky::internal
