#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sky/sky_model.h"

namespace pleinair::compositor {

/// A sky model whose sky and sun are scaled per channel. It removes one of the two light sources,
/// or applies a measured intensity to a model's distribution. `model` must outlive this object.
class ScaledSky : public sky::SkyModel {
 public:
  ScaledSky(const sky::SkyModel& model, LinearRgb sky_radiance_scale, LinearRgb sun_scale)
      : model_(model), sky_radiance_scale_(sky_radiance_scale), sun_scale_(sun_scale) {}

  LinearRgb SkyRadiance(Direction<World> from) const override {
    return model_.SkyRadiance(from) * sky_radiance_scale_;
  }
  LinearRgb SunNormalIrradiance() const override {
    return model_.SunNormalIrradiance() * sun_scale_;
  }
  LinearRgb SkyHorizontalIrradiance() const override {
    return model_.SkyHorizontalIrradiance() * sky_radiance_scale_;
  }
  Direction<World> ToSun() const override { return model_.ToSun(); }
  AirBetween AirTo(Direction<World> towards, Metres distance) const override {
    AirBetween air = model_.AirTo(towards, distance);
    air.inscattered = air.inscattered * sky_radiance_scale_;
    return air;
  }
  std::vector<std::string> Notes() const override { return model_.Notes(); }

 private:
  const sky::SkyModel& model_;
  LinearRgb sky_radiance_scale_, sun_scale_;
};

}  // namespace pleinair::compositor
