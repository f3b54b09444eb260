#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "sky/clouds/cloud_sky.h"
#include "sky/sky_model.h"

namespace pleinair::session {

/// The light of a scene under layers of clouds: their sky, and the sun as it is above them. What
/// the layers take of the sun differs from place to place (session/clouds/cloud_shadow.h).
///
/// The solver and the environment map query the sky often. SkyRadiance() is therefore interpolated
/// between directions 0.6° apart. The aureole within 6° of the sun is narrower than the solver's
/// samples: a lobe of 60° about the sun has its light. RadianceSeen() is exact.
/// SkyHorizontalIrradiance() integrates SkyRadiance().
class CloudedDay : public sky::SkyModel {
 public:
  /// `sky_scale` multiplies the clear sky's radiance, not the sun. Takes about half a second.
  CloudedDay(std::unique_ptr<sky::SkyModel> clear, LinearRgb sky_scale, clouds::CloudFields fields,
             double seconds);

  LinearRgb SkyRadiance(Direction<World> from) const override;
  LinearRgb SunNormalIrradiance() const override { return sun_; }
  LinearRgb SkyHorizontalIrradiance() const override { return horizontal_; }
  Direction<World> ToSun() const override { return clouds_->ToSun(); }
  /// The air below the clouds, in the light of a sun above them as all of this light.
  AirBetween AirTo(Direction<World> towards, Metres distance) const override;
  std::vector<std::string> Notes() const override { return clouds_->Notes(); }

  LinearRgb RadianceSeen(Direction<World> from) const { return clouds_->SkyRadiance(from); }

 private:
  void Tabulate();
  void SpreadAureole();
  LinearRgb IntegrateTable() const;

  LinearRgb sun_;  ///< Above the clouds.
  std::unique_ptr<const clouds::CloudSky> clouds_;
  std::vector<LinearRgb> nodes_;  ///< Hemi-octahedral map, row-major.
  LinearRgb aureole_;             ///< Radiance of the lobe at the sun.
  LinearRgb horizontal_;
  double share_in_air_ = 1.0;  ///< A share of the clear sky's global light.
};

/// A light with the distribution of a clouded sky, for reflections. Sky, sun and air are as strong
/// as those of `light`, which must outlive this object.
class MirroredClouds : public sky::SkyModel {
 public:
  MirroredClouds(const sky::SkyModel& light, CloudedDay clouds);

  LinearRgb SkyRadiance(Direction<World> from) const override {
    return clouds_.SkyRadiance(from) * scale_;
  }
  LinearRgb SunNormalIrradiance() const override { return light_.SunNormalIrradiance(); }
  LinearRgb SkyHorizontalIrradiance() const override { return light_.SkyHorizontalIrradiance(); }
  Direction<World> ToSun() const override { return light_.ToSun(); }
  AirBetween AirTo(Direction<World> towards, Metres distance) const override {
    return light_.AirTo(towards, distance);
  }

 private:
  const sky::SkyModel& light_;
  CloudedDay clouds_;
  LinearRgb scale_;
};

/// A clear sky whose radiance is scaled. The sun stays.
std::unique_ptr<sky::SkyModel> WithScaledSky(std::unique_ptr<sky::SkyModel> clear, LinearRgb scale);

}  // namespace pleinair::session
