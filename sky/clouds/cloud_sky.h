#pragma once

#include <memory>
#include <vector>

#include "base/vector.h"
#include "sky/clouds/cloud_shadow.h"
#include "sky/sky_model.h"

namespace pleinair::clouds {

/// Light of a layer's surroundings, and what the layer leaves of it: means over kCoverSquare_m.
struct LayerLight {
  LinearRgb sky_above;     ///< Diffuse illuminance from above, lux.
  LinearRgb ground_below;  ///< Diffuse illuminance from below, lux.
};

/// Mean illuminances over the area, with the light between layers and ground.
///
/// Each layer reflects S of diffuse light and R(μ₀ τ_slant, μ₀) of direct light. R is the mean over
/// columns that are tilted towards the sun (Várnai & Davies 1999, "tilted independent columns").
/// The fluxes between layers and ground follow by adding.
struct AreaLight {
  std::vector<LayerLight> layers;  ///< In the order of the fields.
  LinearRgb sun_horizontal, sky_horizontal;
};
AreaLight ComputeAreaLight(const CloudFields& fields, const sky::SkyModel& clear,
                           double ground_albedo, double seconds);

/// A clear sky with layers of clouds in front of it, as seen from the place.
///
/// - A ray through a layer is marched. First scattering of the sunlight is exact, with the shadows
/// of
///   the layer and of higher layers on it. HigherOrders has the rest.
/// - Light of the sky above and of the ground below: by the slab of the ray's optical depth. By
///   reciprocity, a slab under isotropic light shows R(τ, μ) of it in the direction μ.
/// - SunNormalIrradiance() is that at the place, with SunTransmittance().
///   SkyHorizontalIrradiance() integrates the dome.
///
/// A homogeneous layer gives IlluminanceBelow() within 2 % (tests/sky/clouds/cloud_sky_test.cc).
class CloudSky : public sky::SkyModel {
 public:
  CloudSky(std::shared_ptr<const sky::SkyModel> clear, CloudFields fields, double ground_albedo,
           double seconds);
  /// The same clouds at another time, with the sun, the clear sky and the means over the area of
  /// `other`. Takes a millisecond.
  CloudSky(const CloudSky& other, double seconds);
  ~CloudSky() override;

  LinearRgb SkyRadiance(Direction<World> from) const override;
  sky::XyY At(Direction<World> from) const override;
  LinearRgb SunNormalIrradiance() const override;
  LinearRgb SkyHorizontalIrradiance() const override;
  Direction<World> ToSun() const override { return clear_->ToSun(); }
  AirBetween AirTo(Direction<World> towards, Metres distance) const override;
  std::vector<std::string> Notes() const override;

  const sky::SkyModel& clear() const { return *clear_; }
  double sun_transmittance() const { return sun_transmittance_; }
  /// SkyHorizontalIrradiance() by `rings` rings of 2 × `rings` directions, and fewer near the sun.
  /// With 24 rings, within 2 % in a thirteenth of the time.
  LinearRgb DomeIlluminance(int rings) const;
  /// Mean illuminance of level ground over the area.
  const AreaLight& area() const { return area_; }

 private:
  struct Optics;
  struct Seen {
    LinearRgb clouds;          ///< cd/m².
    double clear_share = 1.0;  ///< Share of the clear sky's radiance that is seen.
  };
  Seen Look(Direction<World> from) const;

  std::shared_ptr<const sky::SkyModel> clear_;
  CloudFields fields_;  ///< From the lowest base up.
  double seconds_;
  double sun_transmittance_ = 1.0;
  AreaLight area_;
  std::shared_ptr<const Optics> optics_;
  struct Dome;
  std::unique_ptr<Dome> dome_;
};

}  // namespace pleinair::clouds
