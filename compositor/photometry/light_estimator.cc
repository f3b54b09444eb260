#include "compositor/photometry/light_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "compositor/light/scaled_sky.h"
#include "compositor/photometry/estimate/fitted_light.h"
#include "compositor/photometry/heading_from_shadows.h"
#include "compositor/photometry/marker/marker_shade.h"
#include "compositor/photometry/marker/marker_shadow_edge.h"
#include "compositor/photometry/overcast_test.h"
#include "compositor/photometry/shade/ratio_from_shade.h"
#include "compositor/photometry/shade/unmodelled_shadows.h"
#include "compositor/photometry/sun_elsewhere.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "scene/marker_heading.h"
#include "scene/sun_over_place.h"

namespace pleinair::compositor {
namespace {

// Maximum logarithmic brightness difference between planes of one material that an overcast sky
// leaves unexplained.
constexpr double kMaxPlaneContrast = 0.6;
// The same for planes that an overcast sky explains: patterns, bumps and position errors of
// phantoms.
constexpr double kPlaneContrastUnderCloud = 0.3;
// Comparison of planes of several materials by their described colors. Minimum number of surfaces
// and of orientations. Then the minimum logarithmic root mean square under each sun, and its
// minimum ratio to that under clouds. Rough colors add to both alike.
constexpr int kMinSurfaces = 4, kMinDirections = 3;
constexpr double kMinContrastAmongPlanes = 0.2, kTimesWorse = 2.0;
// Minimum number of frames with a divided marker, if so many were used.
constexpr int kMinDividedFrames = 2;
// Sky radiance scales beside a sun, relative to the scene description: as described, and in haze.
constexpr std::array kSkiesWithSun{1.0, 2.0, 4.0};

// Sky radiance scale of the first search for tree shade, before the scale is known. A guess:
// descriptions omit haze more often than anything else. Shallower shade is found only under a
// stronger sky, deeper shade under either.
constexpr LinearRgb kHazierSky{2.0, 2.0, 2.0};

/// Tests the planes under the described sun beside each of kSkiesWithSun.
template <typename Contrast>
std::vector<OvercastTest> SunlitContrasts(const Contrast& contrast_under,
                                          const sky::SkyModel& day) {
  std::vector<OvercastTest> contrasts;
  contrasts.reserve(kSkiesWithSun.size());
  for (const double sky : kSkiesWithSun) {
    contrasts.push_back(contrast_under(ScaledSky(day, LinearRgb{1, 1, 1} * sky, {1.0, 1.0, 1.0})));
  }
  return contrasts;
}

/// True if planes agree with an overcast sky and with no sky that has a sun. Compares planes of one
/// material, or planes of several materials by their described colors.
bool IsLitByCloudsAlone(const OvercastTest& clouds, const std::vector<OvercastTest>& sunlit) {
  const bool within = clouds.within < kPlaneContrastUnderCloud &&
                      std::all_of(sunlit.begin(), sunlit.end(),
                                  [](const auto& sun) { return sun.within > kMaxPlaneContrast; });
  const bool comparable = clouds.surfaces >= kMinSurfaces && clouds.directions >= kMinDirections;
  const bool among =
      comparable && std::all_of(sunlit.begin(), sunlit.end(), [&](const auto& sun) {
        return sun.among > kMinContrastAmongPlanes && sun.among > kTimesWorse * clouds.among;
      });
  return within || among;
}

}  // namespace

LightEstimator::LightEstimator(std::shared_ptr<const PhantomRays> phantoms,
                               const CameraModel& camera,
                               const scene::MarkerReflectance& marker_reflectance,
                               const scene::SceneDescription& scene,
                               const LightOverrides& overrides, UtcTime time,
                               const CameraResponse& response)
    : phantoms_(std::move(phantoms)),
      camera_(camera),
      scene_(scene),
      overrides_(overrides),
      time_(time),
      sun_(scene::SunOver(scene.place_time, time)),
      day_(SunlitSky(scene)->ForSun(sun_.ToSun(), sun_.distance_au)),
      samples_(*phantoms_, camera, marker_reflectance, response),
      meter_(marker_reflectance, *phantoms_, *day_, scene::MarkerFromWorld(scene.marker),
             response) {}

void LightEstimator::Add(CameraImageView image, const Transform<Camera, Marker>& camera_from_marker,
                         bool shows_marker) {
  const auto estimate =
      shows_marker ? meter_.Measure(image, camera_, camera_from_marker) : std::nullopt;
  if (estimate) {
    exposure_scale_ = estimate->exposure_scale;
    dappled_ += estimate->dappled ? 1 : 0;
    // Leaves sometimes make two levels, but neither is direct sunlight.
    const auto shadow = meter_.FindShadow(image, camera_, camera_from_marker);
    if (shadow && !estimate->dappled) marker_shadow_edges_.push_back(*shadow);
  }
  samples_.AddFrame(image, camera_from_marker, exposure_scale_, shows_marker);
}

std::map<int, SurfaceColor> LightEstimator::MeasureColors(
    const LightEstimate& found, const std::set<int>& placed_models) const {
  SkyState skies = found.skies;
  if (!skies.source) skies.source = DescribedSky(scene_);
  if (const auto given = OverriddenSky(scene_, overrides_, sun_)) {
    skies.source = given->skies;
    skies.scale = given->sky_radiance_scale;
  }
  scene::MarkerDescription marker = scene_.marker;
  marker.heading = found.heading;
  const auto day = skies.source->ForSun(sun_.ToSun(), sun_.distance_au);
  return MeasureSurfaceColors(
      *phantoms_, samples_,
      {.meter = meter_,
       .day = ScaledSky(*day, skies.scale, {1.0, 1.0, 1.0}),
       .skies = skies,
       .marker_from_world = scene::MarkerFromWorld(marker),
       .is_known = exposure_scale_ != LinearRgb{1.0, 1.0, 1.0} && !found.measured.sun_doubtful},
      placed_models);
}

bool LightEstimator::IsMarkerDivided(const UnmodelledShadows& unmodelled) const {
  const auto divided = static_cast<int>(marker_shadow_edges_.size());
  return divided > 0 && divided >= std::min(kMinDividedFrames, samples_.frames()) &&
         2 * divided >= samples_.frames() && !unmodelled.ShadesMarker() &&
         (unmodelled.boundary_cells > 0 || MayShine(scene_.cloudiness));
}

void LightEstimator::UseDescribedLight(LightEstimate* found) const {
  const auto skies = DescribedSky(scene_);
  const auto day = skies->ForSun(sun_.ToSun(), sun_.distance_au);
  const double ratio = SunToSky(*day);
  // Without a sun there is no shade.
  if (ratio <= 0.0 || overrides_.sun_to_sky.value_or(ratio) <= 0.0) return;
  const double sky_radiance_scale = ratio / overrides_.sun_to_sky.value_or(ratio);
  const UnmodelledShadows unmodelled = FindUnmodelledShadows(
      *phantoms_, samples_, meter_, *day, scene::MarkerFromWorld(scene_.marker),
      LinearRgb{1, 1, 1} * sky_radiance_scale);
  if (unmodelled.sunlit == 0) return;
  found->skies = {skies, {1.0, 1.0, 1.0}, unmodelled.Matters()};
  found->measured.shaded = unmodelled.shaded;
}

/// Stores where unmodelled objects shade the ground, and corrects for those that shade the marker.
void LightEstimator::UseUnmodelledShadows(UnmodelledShadows unmodelled,
                                          LightEstimate* found) const {
  found->skies.sun_transmittance =
      std::make_shared<const SunTransmittanceMap>(std::move(unmodelled.sun_transmittance));
  if (2 * dappled_ > samples_.frames() || unmodelled.ShadesMarker()) {
    found->skies.marker_shade = MarkerShadeCorrection(
        unmodelled.sunlit_scale.ratio, unmodelled.on_marker.sun, unmodelled.on_marker.ambient);
  }
  found->measured.marker_shade = std::exp(MeanLog(found->skies.marker_shade));
}

SunSkyRatio LightEstimator::EstimateHeadingAndRatio(LightFilter* light_filter,
                                                    LightEstimate* found) const {
  scene::MarkerDescription marker = scene_.marker;
  const Mat3 stated = scene::MarkerFromWorld(marker);
  LightFilter with_reading = *light_filter;
  if (!overrides_.heading_deg) {
    const Vec3 up = stated * Vec3{0.0, 0.0, 1.0};
    const Vec3 to_sun = stated * day_->ToSun().xyz;
    const auto later = [&](double seconds) {
      return stated * scene::SunOver(scene_.place_time, time_.PlusSeconds(seconds)).ToSun().xyz;
    };
    const auto heading = EstimateHeading(*phantoms_, samples_, up, to_sun);
    // Beside a sun elsewhere, a weak maximum near the described heading is a coincidence.
    const auto elsewhere = heading && IsConvincing(*heading)
                               ? std::nullopt
                               : FindSunElsewhere(*phantoms_, samples_, {up, to_sun, later});
    if (elsewhere) {
      found->measured.evidence.sun_elsewhere = elsewhere;
    } else if (heading) {
      with_reading.AddHeading(WeightedHeading(*heading), time_);
    }
  }
  UseHeading({scene_.marker.heading, overrides_.heading_deg.has_value()}, with_reading, time_,
             found);
  marker.heading = found->heading;
  const SunSkyRatio estimate = EstimateSunSkyRatio(
      FindShadowEdges(*phantoms_, samples_, *day_, scene::MarkerFromWorld(marker)));
  if (estimate.sun == SunSkyRatio::Sun::kShines && !found->measured.evidence.sun_elsewhere) {
    *light_filter = with_reading;
  } else {
    // Without a sun the heading was not estimated from shadows.
    UseHeading({scene_.marker.heading, overrides_.heading_deg.has_value()}, *light_filter, time_,
               found);
  }
  found->measured.evidence.edges = estimate.edges;
  found->measured.evidence.edges_agreeing = estimate.agreeing;
  found->measured.evidence.edges_with_contrast = estimate.share_with_contrast;
  return estimate;
}

LightEstimate LightEstimator::Estimate(LightFilter* light_filter) const {
  LightEstimate found;
  found.heading = scene_.marker.heading;
  MeasuredLight& light = found.measured;
  light.evidence.frames = samples_.frames();
  if (overrides_.as_described) {
    UseDescribedLight(&found);
    return found;
  }
  if (overrides_.fitted && !overrides_.sun_to_sky) {
    return EstimateByFit({.phantoms = *phantoms_,
                          .samples = samples_,
                          .meter = meter_,
                          .scene = scene_,
                          .heading_given = overrides_.heading_deg.has_value(),
                          .time = time_,
                          .sun = sun_,
                          .day = *day_,
                          .has_exposure = exposure_scale_ != LinearRgb{1.0, 1.0, 1.0},
                          .dappled = 2 * dappled_ > samples_.frames()},
                         light_filter);
  }
  const SunSkyRatio estimate = EstimateHeadingAndRatio(light_filter, &found);
  using Sun = SunSkyRatio::Sun;
  scene::MarkerDescription marker = scene_.marker;
  marker.heading = found.heading;
  const auto shade_under = [&](LinearRgb sky_radiance_scale) {
    return FindUnmodelledShadows(*phantoms_, samples_, meter_, *day_,
                                 scene::MarkerFromWorld(marker), sky_radiance_scale);
  };
  const bool overridden = overrides_.sun_to_sky.has_value();
  if (overridden && *overrides_.sun_to_sky <= 0.0) return found;
  LinearRgb scale = estimate.sky_radiance_scale;
  const auto known = overridden ? std::nullopt : light_filter->SkyBesideSun(time_);
  if (known && estimate.sun != Sun::kShines) scale = known->scale;
  if (overridden) scale = LinearRgb{1, 1, 1} * (SunToSky(*day_) / *overrides_.sun_to_sky);
  UnmodelledShadows unmodelled = shade_under(scale);
  const bool may_shine = MayShine(scene_.cloudiness);
  const auto plane_contrast = [&](const sky::SkyModel& day) {
    return TestForOvercast(*phantoms_, samples_, day, scene::MarkerFromWorld(marker));
  };
  const auto overcast = OvercastSky();
  const auto settle_overcast = [&] {
    light.sun_source = MeasuredLight::Source::kMeasured;
    light.sun_shines = false;
    found.skies.source = overcast;
    light_filter->AddClouds();
    light_filter->Keep(light, found.skies);
    return found;
  };
  const auto settle_as_before = [&] {
    light_filter->Recall(time_, &light, &found.skies);
    return found;
  };
  const auto contrast_under_cloud = [&] {
    return plane_contrast(*overcast->ForSun(sun_.ToSun(), sun_.distance_au));
  };
  // No shadow tells of a sun that stands elsewhere.
  if (light.evidence.sun_elsewhere && !overridden) {
    light.sun_doubtful = true;
    return settle_as_before();
  }
  // Soft shade is also tested as wide at the shallower depth that haze gives it.
  const bool edges_hidden =
      may_shine && unmodelled.HidesEdges() &&
      (unmodelled.CastBySun() || unmodelled.IsWide() || shade_under(kHazierSky).IsWide());
  if (estimate.sun == Sun::kHidden && !edges_hidden) {
    // A given ratio implies that the sun shines. The frames do not show where, nor its shade.
    if (overridden) return found;
    light.sun_doubtful =
        unmodelled.CastBySun() || contrast_under_cloud().within > kMaxPlaneContrast;
    // The sun's position is doubtful, too, and so would be any shade derived from it.
    if (light.sun_doubtful) return settle_as_before();
    return settle_overcast();
  }
  // Too few edges, behind a house for example. The planes' light may still exclude a sun.
  if (!overridden && may_shine && estimate.sun == Sun::kUnknown && !unmodelled.CastBySun() &&
      IsLitByCloudsAlone(contrast_under_cloud(), SunlitContrasts(plane_contrast, *day_))) {
    light.evidence.edges_agreeing = 0;
    return settle_overcast();
  }
  const auto use_sun = [&](const SunSkyRatio& seen) {
    light_filter->AddSun(WeightedScale(seen, scene_.cloudiness), time_);
    const auto with_seen = light_filter->SkyBesideSun(time_);
    scale = with_seen->scale;
    light.sun_to_sky_error = with_seen->relative_error;
  };
  if (!overridden && estimate.sun == Sun::kShines) {
    light.sun_source = MeasuredLight::Source::kMeasured;
    SunSkyRatio edges = estimate;
    if (unmodelled.HidesEdges()) {
      // Half-light on the sunny side makes the sky look too strong, there and between the leaves.
      // The weaker estimate counts.
      const SunSkyRatio depth =
          EstimateRatioFromShade(*phantoms_, unmodelled, *day_, scene::MarkerFromWorld(marker));
      if (depth.sun == Sun::kShines && depth.sky_radiance_scale.g < estimate.sky_radiance_scale.g) {
        edges = depth;
        light.sun_source = MeasuredLight::Source::kShade;
        light.evidence.shade_places = depth.agreeing;
      }
    }
    use_sun(edges);
    if (light.sun_source == MeasuredLight::Source::kShade) unmodelled = shade_under(scale);
  } else if (!overridden) {
    // One material and a sharp edge: more certain than the deepest tree shade.
    SunSkyRatio seen;
    if (IsMarkerDivided(unmodelled)) {
      seen = EstimateRatioFromMarkerShadow(*phantoms_, marker_shadow_edges_, *day_,
                                           scene::MarkerFromWorld(marker));
    }
    if (seen.sun == Sun::kShines) {
      light.sun_source = MeasuredLight::Source::kMarker;
    } else {
      if (!may_shine || unmodelled.sunlit == 0) return settle_as_before();
      // Also searches for shade half as deep as described, because descriptions omit haze.
      const UnmodelledShadows probe = shade_under(kHazierSky);
      if (probe.Matters()) {
        seen = EstimateRatioFromShade(*phantoms_, probe, *day_, scene::MarkerFromWorld(marker));
      }
      if (seen.sun == Sun::kShines) {
        light.sun_source = MeasuredLight::Source::kShade;
        light.evidence.shade_places = seen.agreeing;
      }
    }
    if (seen.sun == Sun::kShines) {
      use_sun(seen);
      unmodelled = shade_under(scale);
    }
  }
  const bool estimated = overridden || light.sun_source != MeasuredLight::Source::kDescription;
  if (!estimated && light_filter->ObservedClouds()) return settle_as_before();
  if (!estimated) light_filter->RestoreSources(time_, &light);
  if (estimated || known) {
    const SkyFit sky = SkyScaledBesideSun(*day_, scale, sun_.distance_au);
    found.skies = {sky.skies, sky.sky_radiance_scale, unmodelled.Matters()};
  } else {
    found.skies = {DescribedSky(scene_), {1.0, 1.0, 1.0}, unmodelled.Matters()};
  }
  light.shaded = unmodelled.shaded;
  if (unmodelled.Matters()) UseUnmodelledShadows(std::move(unmodelled), &found);
  if (!overridden) light_filter->Keep(light, found.skies);
  return found;
}

}  // namespace pleinair::compositor
