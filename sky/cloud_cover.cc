#include "sky/cloud_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "sky/air_mass.h"
#include "sky/sky_sources.h"

namespace pleinair::sky {
namespace {

// At covers of 0, 1/3, 2/3 and 1.
constexpr std::array<int, 4> kCieTypes = {11, 8, 4, 1};

Radians ElevationOf(Direction<World> to) {
  return Radians(std::asin(std::clamp(to.xyz.z, -1.0, 1.0)));
}

class CloudySky : public SkyModel {
 public:
  CloudySky(std::unique_ptr<SkyModel> clear, double cover)
      : clear_(std::move(clear)),
        cover_(cover),
        passed_(TransmissionOfClouds(cover, ElevationOf(clear_->ToSun()))) {}

  LinearRgb SkyRadiance(Direction<World> from) const override {
    return Made().Radiance(from, clear_->SkyRadiance(from));
  }
  XyY At(Direction<World> from) const override {
    const double cloud = Made().Luminance(from);
    const Vec3 blue = XyzFromXyY(clear_->At(from)) * passed_.clear_sky;
    return XyYFromXyz(blue + XyzFromRgb({cloud, cloud, cloud}));
  }
  LinearRgb SunNormalIrradiance() const override {
    return clear_->SunNormalIrradiance() * passed_.sun;
  }
  LinearRgb SkyHorizontalIrradiance() const override { return Made().SkyHorizontalIrradiance(); }
  Direction<World> ToSun() const override { return clear_->ToSun(); }
  AirBetween AirTo(Direction<World> towards, Metres distance) const override {
    // Inscattered light scales with the horizontal illuminance under the clouds.
    AirBetween air = clear_->AirTo(towards, distance);
    air.inscattered = air.inscattered * passed_.global;
    return air;
  }
  std::vector<std::string> Notes() const override { return clear_->Notes(); }

 private:
  /// Computed on first use: a caller that needs the sun alone does not pay for it.
  const Clouds& Made() const {
    std::call_once(made_, [this] {
      clouds_.emplace(cover_, ToSun(), clear_->SkyHorizontalIrradiance(),
                      clear_->SunNormalIrradiance());
    });
    return *clouds_;
  }

  std::unique_ptr<SkyModel> clear_;
  double cover_;
  CloudTransmission passed_;
  mutable std::once_flag made_;
  mutable std::optional<Clouds> clouds_;
};

class CloudySource : public SkySource {
 public:
  CloudySource(std::shared_ptr<const SkySource> clear, double cover)
      : clear_(std::move(clear)), cover_(cover) {}
  std::unique_ptr<SkyModel> ForSun(Direction<World> to_sun, double distance_au) const override {
    return std::make_unique<CloudySky>(clear_->ForSun(to_sun, distance_au), cover_);
  }

 private:
  std::shared_ptr<const SkySource> clear_;
  double cover_;
};

}  // namespace

CloudTransmission TransmissionOfClouds(double cover, Radians apparent_sun_elevation) {
  const double c = std::clamp(cover, 0.0, 1.0);
  const double beam_share = 1.0 - std::pow(c, 2.5);  // e^(−τ).
  return {1.0 - 0.75 * std::pow(c, 3.4),
          std::pow(beam_share, RelativeAirMass(apparent_sun_elevation)), 1.0 - c};
}

CloudPatterns PatternsOfClouds(double cover) {
  const double place = 3.0 * std::clamp(cover, 0.0, 1.0);
  const int lower = std::min(static_cast<int>(place), 2);
  return {kCieTypes[lower], kCieTypes[lower + 1], place - lower};
}

Clouds::Clouds(double cover, Direction<World> to_sun, const LinearRgb& clear_sky,
               const LinearRgb& clear_sun)
    : lower_(PatternsOfClouds(cover).lower, to_sun), upper_(PatternsOfClouds(cover).upper, to_sun) {
  const CloudTransmission passed = TransmissionOfClouds(cover, ElevationOf(to_sun));
  clear_share_ = passed.clear_sky;
  // Horizontal illuminance of the clouds: the global illuminance less the parts of sun and clear
  // sky.
  const double sun = pleinair::Luminance(clear_sun) * std::max(0.0, to_sun.xyz.z);
  const double lux =
      std::max(0.0, (passed.global - passed.clear_sky) * pleinair::Luminance(clear_sky) +
                        (passed.global - passed.sun) * sun);
  const double upper_share = PatternsOfClouds(cover).upper_share;
  lower_zenith_cd_m2_ = lux * (1.0 - upper_share) / lower_.IlluminanceOverZenith();
  upper_zenith_cd_m2_ = lux * upper_share / upper_.IlluminanceOverZenith();
  sky_horizontal_ = clear_sky * passed.clear_sky + LinearRgb{lux, lux, lux};
}

std::shared_ptr<const SkySource> internal::MakeCloudySource(std::shared_ptr<const SkySource> clear,
                                                            double cover) {
  return std::make_shared<CloudySource>(std::move(clear), cover);
}

}  // namespace pleinair::sky
