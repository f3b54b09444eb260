#include <algorithm>
#include <cmath>

#include "sky/cie_sky.h"
#include "sky/perez.h"
#include "sky/sky_sources.h"
#include "sky/standard_illuminance.h"
#include "sky/sunlight_spectrum.h"

namespace pleinair::sky::internal {
namespace {

/// Cloudiness whose IES illuminance a type gets when no scale is given: the standard defines
/// patterns only. Types 1 to 5 are overcast, 6 to 10 partly cloudy, 11 to 15 cloudless (ISO
/// 15469:2004, Table 1).
SkyCondition ConditionOfType(int type) {
  if (type <= 5) return SkyCondition::kOvercast;
  return type <= 10 ? SkyCondition::kPartlyCloudy : SkyCondition::kClear;
}

/// Neutral (D65): the standard defines no colors.
LinearRgb Neutral(double luminance) { return {luminance, luminance, luminance}; }

class CieModel : public SkyModel {
 public:
  CieModel(int type, const SkyConditions& conditions, Direction<World> to_sun, double distance_au)
      : to_sun_(to_sun), cie_(type, to_sun) {
    const Radians elevation(std::asin(std::clamp(to_sun.xyz.z, -1.0, 1.0)));
    const SkyCondition condition = ConditionOfType(type);
    const StandardIlluminance ies = ComputeStandardIlluminance(condition, elevation, distance_au);
    zenith_cd_m2_ =
        conditions.zenith_luminance
            ? conditions.zenith_luminance->value()
            : conditions.sky_horizontal_illuminance.value_or(ies.sky_horizontal).value() /
                  cie_.IlluminanceOverZenith();
    const LinearRgb sun = DirectSunIrradiance(PerezSky::kDefaultTurbidity, elevation, distance_au);
    if (const double luminance = Luminance(sun); luminance > 0.0) {
      sun_normal_ = sun * (ies.sun_normal.value() / luminance);
    }
  }

  LinearRgb SkyRadiance(Direction<World> from) const override {
    return Neutral(zenith_cd_m2_ * cie_.RelativeLuminance(from));
  }
  LinearRgb SunNormalIrradiance() const override { return sun_normal_; }
  LinearRgb SkyHorizontalIrradiance() const override {
    return Neutral(zenith_cd_m2_ * cie_.IlluminanceOverZenith());
  }
  Direction<World> ToSun() const override { return to_sun_; }

 private:
  Direction<World> to_sun_;
  CieSky cie_;
  double zenith_cd_m2_ = 0.0;
  LinearRgb sun_normal_;
};

class CieSource : public SkySource {
 public:
  CieSource(int type, const SkyConditions& conditions) : type_(type), conditions_(conditions) {}
  std::unique_ptr<SkyModel> ForSun(Direction<World> to_sun, double distance_au) const override {
    return std::make_unique<CieModel>(type_, conditions_, to_sun, distance_au);
  }

 private:
  int type_;
  SkyConditions conditions_;
};

}  // namespace

std::shared_ptr<const SkySource> MakeCieSource(int type, const SkyConditions& conditions) {
  return std::make_shared<CieSource>(type, conditions);
}

}  // namespace pleinair::sky::internal
