#include "compositor/photometry/sky_fit.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "sky/daylight.h"

namespace pleinair::compositor {
namespace {

// Range of turbidity. Beyond the maximum, clouds are added instead of haze.
constexpr double kClearest = 1.2, kHaziest = 6.0;
constexpr double kCloudyTurbidity = 3.2;
constexpr double kThickestCover = 0.98;
// Logarithmic tolerance of the sky-to-sun ratio. Each try builds an atmosphere; a scale of the sky
// takes the remaining difference.
constexpr double kNearEnough = 0.01;
constexpr int kMaxTries = 12;
constexpr double kFarOff = 5.0;
// Uncertainty of a heading from a compass and a person.
constexpr double kHeadingDoubtDeg = 4.0;
// Logarithmic uncertainty of the sky's color beside its sun: of the model and of the measurement.
constexpr double kModelColorDoubt = 0.10, kMeasuredColorDoubt = 0.08;

sky::SkyCondition ConditionOf(scene::Cloudiness cloudiness) {
  switch (cloudiness) {
    case scene::Cloudiness::kClear:
      return sky::SkyCondition::kClear;
    case scene::Cloudiness::kHazy:
      return sky::SkyCondition::kHazy;
    case scene::Cloudiness::kPartlyCloudy:
      return sky::SkyCondition::kPartlyCloudy;
    case scene::Cloudiness::kOvercast:
      return sky::SkyCondition::kOvercast;
  }
  return sky::SkyCondition::kClear;
}

/// Logarithmic uncertainty of the sky's strength beside the sun in a scene description.
double DoubtOf(scene::Cloudiness stated) {
  switch (stated) {
    case scene::Cloudiness::kClear:
      return 0.35;
    case scene::Cloudiness::kHazy:
      return 0.6;
    case scene::Cloudiness::kPartlyCloudy:
    case scene::Cloudiness::kOvercast:
      return 1.2;
  }
  return 1.2;
}

/// Finds the zero of a rising function between `low` and `high`; the nearer end if there is none.
/// Uses false position, Illinois algorithm: Dowell & Jarratt 1971, "A modified regula falsi method
/// for computing the root of an equation", BIT 11, p. 168.
template <typename Function>
double ZeroBetween(double low, double high, const Function& function) {
  double at_low = function(low), at_high = function(high);
  if (at_low >= 0.0) return low;
  if (at_high <= 0.0) return high;
  double tried = 0.5 * (low + high);
  int last_side = 0;
  for (int i = 0; i < kMaxTries; ++i) {
    tried = (low * at_high - high * at_low) / (at_high - at_low);
    const double value = function(tried);
    if (std::fabs(value) < kNearEnough) break;
    const int side = value < 0.0 ? -1 : 1;
    (side < 0 ? low : high) = tried;
    (side < 0 ? at_low : at_high) = value;
    // An end that stays slows the convergence.
    if (side == last_side) (side < 0 ? at_high : at_low) *= 0.5;
    last_side = side;
  }
  return tried;
}

std::shared_ptr<const sky::SkySource> Make(double turbidity, double cover) {
  sky::SkyConditions conditions;
  conditions.turbidity = turbidity;
  conditions.cloud_cover = cover;
  auto source = sky::SkySource::Create({sky::SkyModelKind::kAtmosphere, 0}, conditions);
  CHECK_EQ(source.has_value(), true);
  return *std::move(source);
}

}  // namespace

bool MayShine(scene::Cloudiness stated) {
  return stated == scene::Cloudiness::kClear || stated == scene::Cloudiness::kHazy;
}

std::shared_ptr<const sky::SkySource> DescribedSky(const scene::SceneDescription& scene) {
  return sky::CreateDaylight({ConditionOf(scene.cloudiness), scene.turbidity.value_or(0.0)});
}

std::shared_ptr<const sky::SkySource> SunlitSky(const scene::SceneDescription& scene) {
  const bool veiled = scene.cloudiness == scene::Cloudiness::kPartlyCloudy ||
                      scene.cloudiness == scene::Cloudiness::kOvercast;
  return veiled ? sky::CreateDaylight({sky::SkyCondition::kClear, 0.0}) : DescribedSky(scene);
}

std::shared_ptr<const sky::SkySource> OvercastSky() {
  return sky::CreateDaylight({sky::SkyCondition::kOvercast, 0.0});
}

double SunToSky(const sky::SkyModel& day) {
  const double sky = Luminance(day.SkyHorizontalIrradiance());
  const double sun = Luminance(day.SunNormalIrradiance()) * std::max(0.0, day.ToSun().xyz.z);
  return sky > 0.0 ? sun / sky : 0.0;
}

SkyFit SkyWithShare(LinearRgb sky_over_sun, Direction<World> to_sun, double sun_distance_au) {
  const double wanted = Luminance(sky_over_sun);
  if (!(wanted > 0.0) || !std::isfinite(wanted)) return {OvercastSky()};  // There is no sun.
  /// Logarithmic excess of a sky's strength beside its sun.
  const auto excess = [&](const std::shared_ptr<const sky::SkySource>& source) {
    const auto day = source->ForSun(to_sun, sun_distance_au);
    const double share =
        Luminance(day->SkyHorizontalIrradiance()) / Luminance(day->SunNormalIrradiance());
    return std::clamp(std::log(share / wanted), -kFarOff, kFarOff);  // Finite without a sun, too.
  };
  const auto hazy = [](double log_turbidity) { return Make(std::exp(log_turbidity), 0.0); };
  const auto cloudy = [](double cover) { return Make(kCloudyTurbidity, cover); };
  SkyFit measured;
  const double haze =
      ZeroBetween(std::log(kClearest), std::log(kHaziest),
                  [&](double log_turbidity) { return excess(hazy(log_turbidity)); });
  measured.skies = haze < std::log(kHaziest)
                       ? hazy(haze)
                       : cloudy(ZeroBetween(0.0, kThickestCover,
                                            [&](double cover) { return excess(cloudy(cover)); }));
  const auto day = measured.skies->ForSun(to_sun, sun_distance_au);
  measured.sky_radiance_scale =
      sky_over_sun * day->SunNormalIrradiance() / day->SkyHorizontalIrradiance();
  return measured;
}

SkyFit SkyScaledBesideSun(const sky::SkyModel& day, LinearRgb scale, double sun_distance_au) {
  const LinearRgb share = day.SkyHorizontalIrradiance() / day.SunNormalIrradiance();
  return SkyWithShare(share * scale, day.ToSun(), sun_distance_au);
}

std::optional<SkyFit> OverriddenSky(const scene::SceneDescription& scene,
                                    const LightOverrides& overrides, const sky::SunPosition& sun) {
  if (!overrides.sun_to_sky) return std::nullopt;
  if (*overrides.sun_to_sky <= 0.0 || sun.ToSun().xyz.z <= 0.0) return SkyFit{OvercastSky()};
  const auto day = SunlitSky(scene)->ForSun(sun.ToSun(), sun.distance_au);
  const double scale = SunToSky(*day) / *overrides.sun_to_sky;
  return SkyScaledBesideSun(*day, {scale, scale, scale}, sun.distance_au);
}

SkyRadianceScale WeightedScale(const SunSkyRatio& estimate, scene::Cloudiness stated) {
  const LinearRgb& s = estimate.sky_radiance_scale;
  const double log_r = std::log(s.r), log_g = std::log(s.g), log_b = std::log(s.b);
  // Rec.709 weights, as for all luminance.
  const double log_mean = Luminance({log_r, log_g, log_b});
  const auto share = [](double prior, double measured) {
    return prior * prior / (prior * prior + measured * measured);
  };
  const double doubt = DoubtOf(stated);
  const double mean = log_mean * share(doubt, estimate.log_uncertainty);
  const double color = share(kModelColorDoubt, kMeasuredColorDoubt);
  return {{std::exp(mean + color * (log_r - log_mean)), std::exp(mean + color * (log_g - log_mean)),
           std::exp(mean + color * (log_b - log_mean))},
          estimate.log_uncertainty * std::sqrt(share(doubt, estimate.log_uncertainty))};
}

HeadingOffset WeightedHeading(const HeadingEstimate& estimate) {
  const double measured = ToDegrees(estimate.uncertainty);
  const double trust = kHeadingDoubtDeg * kHeadingDoubtDeg /
                       (kHeadingDoubtDeg * kHeadingDoubtDeg + measured * measured);
  return {FromDegrees(ToDegrees(estimate.offset) * trust),
          FromDegrees(measured * std::sqrt(trust))};
}

}  // namespace pleinair::compositor
