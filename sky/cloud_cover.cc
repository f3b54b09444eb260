#include "sky/cloud_cover.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
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

/// The clouds' own light.
struct Clouds {
  CieSky lower, upper;
  double lower_zenith_cd_m2 = 0.0, upper_zenith_cd_m2 = 0.0;
  LinearRgb sky_horizontal = {};  ///< With what is left of the clear sky.

  double Luminance(Direction<World> from) const {
    return lower_zenith_cd_m2 * lower.RelativeLuminance(from) +
           upper_zenith_cd_m2 * upper.RelativeLuminance(from);
  }
};

class CloudySky : public SkyModel {
 public:
  CloudySky(std::unique_ptr<SkyModel> clear, double cover)
      : clear_(std::move(clear)),
        cover_(cover),
        sine_(std::clamp(clear_->ToSun().xyz.z, -1.0, 1.0)),
        passed_(TransmissionOfClouds(cover, Radians(std::asin(sine_)))) {}

  LinearRgb SkyRadiance(Direction<World> from) const override {
    const double cloud = Made().Luminance(from);
    return clear_->SkyRadiance(from) * passed_.clear_sky + LinearRgb{cloud, cloud, cloud};
  }
  XyY At(Direction<World> from) const override {
    const double cloud = Made().Luminance(from);
    const Vec3 blue = XyzFromXyY(clear_->At(from)) * passed_.clear_sky;
    return XyYFromXyz(blue + XyzFromRgb({cloud, cloud, cloud}));
  }
  LinearRgb SunNormalIrradiance() const override {
    return clear_->SunNormalIrradiance() * passed_.sun;
  }
  LinearRgb SkyHorizontalIrradiance() const override { return Made().sky_horizontal; }
  Direction<World> ToSun() const override { return clear_->ToSun(); }
  AirBetween AirTo(Direction<World> towards, Metres distance) const override {
    // The same air, lit by what the clouds leave of the light on level ground.
    AirBetween air = clear_->AirTo(towards, distance);
    air.inscattered = air.inscattered * passed_.global;
    return air;
  }
  std::vector<std::string> Notes() const override { return clear_->Notes(); }

 private:
  /// Made when first asked for: who follows the sun alone does without.
  const Clouds& Made() const {
    std::call_once(made_, [this] {
      const PatternBlend blend = BlendAt(cover_);
      Clouds& clouds =
          clouds_.emplace(Clouds{CieSky(blend.lower, ToSun()), CieSky(blend.upper, ToSun())});
      const LinearRgb blue = clear_->SkyHorizontalIrradiance();
      const double clear_sun = Luminance(clear_->SunNormalIrradiance()) * std::max(0.0, sine_);
      const double diffuse =
          passed_.global * (clear_sun + Luminance(blue)) - passed_.sun * clear_sun;
      const double lux = std::max(0.0, diffuse - passed_.clear_sky * Luminance(blue));
      clouds.lower_zenith_cd_m2 =
          lux * (1.0 - blend.upper_share) / clouds.lower.IlluminanceOverZenith();
      clouds.upper_zenith_cd_m2 = lux * blend.upper_share / clouds.upper.IlluminanceOverZenith();
      clouds.sky_horizontal = blue * passed_.clear_sky + LinearRgb{lux, lux, lux};
    });
    return *clouds_;
  }

  std::unique_ptr<SkyModel> clear_;
  double cover_;
  double sine_;  ///< Of the sun's elevation.
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

std::shared_ptr<const SkySource> internal::MakeCloudySource(std::shared_ptr<const SkySource> clear,
                                                            double cover) {
  return std::make_shared<CloudySource>(std::move(clear), cover);
}

}  // namespace pleinair::sky
