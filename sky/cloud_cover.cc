#include "sky/cloud_cover.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sky/air_mass.h"
#include "sky/cie_sky.h"
#include "sky/sky_sources.h"

namespace pleinair::sky {
namespace {

struct Pattern {
  double cover;
  int cie_type;
};
constexpr Pattern kPatterns[] = {{0.0, 11}, {1.0 / 3.0, 8}, {2.0 / 3.0, 4}, {1.0, 1}};

/// The pattern below `cover`, the one above it, and the latter's share.
struct PatternBlend {
  int lower = 0, upper = 0;
  double upper_share = 0.0;
};
PatternBlend BlendAt(double cover) {
  std::size_t i = 0;
  while (i + 2 < std::size(kPatterns) && cover > kPatterns[i + 1].cover) ++i;
  const Pattern& low = kPatterns[i];
  const Pattern& high = kPatterns[i + 1];
  return {low.cie_type, high.cie_type, (cover - low.cover) / (high.cover - low.cover)};
}

class CloudySky : public SkyModel {
 public:
  CloudySky(std::unique_ptr<SkyModel> clear, double cover)
      : clear_(std::move(clear)),
        blend_(BlendAt(cover)),
        lower_(blend_.lower, clear_->ToSun()),
        upper_(blend_.upper, clear_->ToSun()) {
    const double sine = std::clamp(clear_->ToSun().xyz.z, -1.0, 1.0);
    const CloudTransmission passed = TransmissionOfClouds(cover, Radians(std::asin(sine)));
    global_ = passed.global;
    clear_share_ = passed.clear_sky;
    sun_normal_ = clear_->SunNormalIrradiance() * passed.sun;
    const LinearRgb blue = clear_->SkyHorizontalIrradiance();
    const double clear_sun = Luminance(clear_->SunNormalIrradiance()) * std::max(0.0, sine);
    const double diffuse = passed.global * (clear_sun + Luminance(blue)) - passed.sun * clear_sun;
    cloud_lux_ = std::max(0.0, diffuse - clear_share_ * Luminance(blue));
    lower_scale_ = cloud_lux_ * (1.0 - blend_.upper_share) / lower_.IlluminanceOverZenith();
    upper_scale_ = cloud_lux_ * blend_.upper_share / upper_.IlluminanceOverZenith();
    sky_horizontal_ = blue * clear_share_ + LinearRgb{cloud_lux_, cloud_lux_, cloud_lux_};
  }

  LinearRgb SkyRadiance(Direction<World> from) const override {
    const double cloud = CloudLuminance(from);
    return clear_->SkyRadiance(from) * clear_share_ + LinearRgb{cloud, cloud, cloud};
  }
  XyY At(Direction<World> from) const override {
    const double cloud = CloudLuminance(from);
    const Vec3 blue = XyzFromXyY(clear_->At(from)) * clear_share_;
    return XyYFromXyz(blue + XyzFromRgb({cloud, cloud, cloud}));
  }
  LinearRgb SunNormalIrradiance() const override { return sun_normal_; }
  LinearRgb SkyHorizontalIrradiance() const override { return sky_horizontal_; }
  Direction<World> ToSun() const override { return clear_->ToSun(); }
  AirBetween AirTo(Direction<World> towards, Metres distance) const override {
    // The same air, lit by what the clouds leave of the light on level ground.
    AirBetween air = clear_->AirTo(towards, distance);
    air.inscattered = air.inscattered * global_;
    return air;
  }
  std::vector<std::string> Notes() const override { return clear_->Notes(); }

 private:
  double CloudLuminance(Direction<World> from) const {
    return lower_scale_ * lower_.RelativeLuminance(from) +
           upper_scale_ * upper_.RelativeLuminance(from);
  }

  std::unique_ptr<SkyModel> clear_;
  PatternBlend blend_;
  CieSky lower_, upper_;
  double global_ = 1.0;  ///< Of the clear light on level ground.
  double clear_share_ = 1.0;
  double cloud_lux_ = 0.0;
  double lower_scale_ = 0.0, upper_scale_ = 0.0;  ///< Zenith luminances, cd/m².
  LinearRgb sun_normal_;
  LinearRgb sky_horizontal_;
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

std::shared_ptr<const SkySource> internal::MakeCloudySource(std::shared_ptr<const SkySource> clear,
                                                            double cover) {
  return std::make_shared<CloudySource>(std::move(clear), cover);
}

}  // namespace pleinair::sky
