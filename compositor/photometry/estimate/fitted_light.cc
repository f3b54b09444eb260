#include "compositor/photometry/estimate/fitted_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "compositor/light/scaled_sky.h"
#include "compositor/photometry/estimate/light_cells.h"
#include "compositor/photometry/estimate/light_posterior.h"
#include "compositor/photometry/estimate/light_prior.h"
#include "compositor/photometry/estimate/sunlight_map.h"
#include "compositor/photometry/heading_from_shadows.h"
#include "compositor/photometry/marker/marker_shade.h"
#include "compositor/photometry/sky_fit.h"
#include "scene/marker_heading.h"

namespace pleinair::compositor {
namespace {

// Probability from which a hypothesis counts as seen. Below it, the words stand.
constexpr double kSure = 0.95;
// The frames tell the sky's strength where they leave less than this of the words' doubt.
constexpr double kTold = 0.8;
// Share of the sunlit places from which unmodelled shade must be looked for in each image.
constexpr double kMinShaded = 0.02;
// Edges of phantoms' shadows that make a measurement; otherwise it is one of the shade or marker.
constexpr int kMinEdges = 3;
// Points of the marker where the model's light is traced, and paths each.
constexpr std::size_t kMarkerPoints = 8;
constexpr std::uint32_t kMarkerPaths = 512;

LinearRgb Exp(const LogRgb& logs) {
  return {std::exp(logs[0]), std::exp(logs[1]), std::exp(logs[2])};
}

MarkerLight LightOnMarker(const FittedLightInput& input, const Mat3& marker_from_world,
                          const sky::SkyModel& clouds) {
  MarkerLight light;
  const auto& places = input.meter.places();
  if (places.empty()) return light;
  constexpr Vec3 kNormal{0, 0, 1};
  std::vector<Point<Marker>> points;
  const std::size_t count = std::min(places.size(), kMarkerPoints);
  for (std::size_t i = 0; i < count; ++i) points.push_back(places[i * places.size() / count]);
  const auto mean = [&](const sky::SkyModel& day) {
    LinearRgb sum;
    for (const LinearRgb& value :
         input.phantoms.Ambient(points, kNormal, day, marker_from_world, kMarkerPaths))
      sum = sum + value * (1.0 / static_cast<double>(count));
    return sum;
  };
  light.from = {mean(ScaledSky(input.day, {1, 1, 1}, {})),
                mean(ScaledSky(input.day, {}, {1, 1, 1})), mean(clouds)};
  if (Luminance(light.from.sky) <= 0.0) return light;
  if (input.has_exposure) light.predicted = input.meter.light_on_marker();
  if (input.meter.in_sun()) {
    const Vec3 to_sun = marker_from_world * input.day.ToSun().xyz;
    light.sun = input.day.SunNormalIrradiance() * std::max(0.0, Dot(kNormal, to_sun));
  }
  light.dappled = input.dappled;
  return light;
}

/// What a sky that was seen beside the sun is called after: the evidence that told it.
MeasuredLight::Source SourceOf(const LightPosterior& posterior) {
  using Source = MeasuredLight::Source;
  if (posterior.counted.edges_agreeing >= kMinEdges) return Source::kMeasured;
  return posterior.counted.marker_steps > 0 ? Source::kMarker : Source::kShade;
}

/// The fit at one heading.
struct Fitted {
  std::vector<LightCell> cells;
  MarkerLight on_marker;
  LightPosterior posterior;
  Vec3 to_sun;
};

Fitted FitAt(const FittedLightInput& input, Radians heading) {
  scene::MarkerDescription marker = input.scene.marker;
  marker.heading = heading;
  const Mat3 marker_from_world = scene::MarkerFromWorld(marker);
  const auto clouds = OvercastSky()->ForSun(input.sun.ToSun(), input.sun.distance_au);
  Fitted fitted;
  fitted.to_sun = Normalized(marker_from_world * input.day.ToSun().xyz);
  fitted.cells =
      FindLightCells(input.phantoms, input.samples, input.day, *clouds, marker_from_world);
  fitted.on_marker = LightOnMarker(input, marker_from_world, *clouds);
  fitted.posterior = FitLight(fitted.cells, {.marker = fitted.on_marker,
                                             .sun = input.day.SunNormalIrradiance(),
                                             .up = marker_from_world * Vec3{0, 0, 1},
                                             .to_sun = fitted.to_sun,
                                             .prior = PriorOf(input.scene.cloudiness)});
  return fitted;
}

/// The sun shines beside a sky of this scale: stores what unmodelled things shade.
void UseShade(const FittedLightInput& input, const Fitted& fitted, LinearRgb scale,
              LightEstimate* found) {
  const LightPosterior& posterior = fitted.posterior;
  found->measured.shaded = posterior.shaded;
  found->skies.unmodelled_shadows = posterior.shaded >= kMinShaded;
  if (!found->skies.unmodelled_shadows) return;
  found->skies.sun_transmittance = std::make_shared<const SunTransmittanceMap>(
      MapSunlight(input.phantoms, input.samples, fitted.cells, posterior, fitted.to_sun));
  const CellLight& from = fitted.on_marker.from;
  found->skies.marker_shade =
      MarkerShadeCorrection(std::exp(posterior.log_marker_shade), fitted.on_marker.sun,
                            from.sky * scale + from.reflected);
  found->measured.marker_shade = std::exp(MeanLog(found->skies.marker_shade));
}

}  // namespace

LightEstimate EstimateByFit(const FittedLightInput& input, LightFilter* light_filter) {
  using Source = MeasuredLight::Source;
  LightEstimate found;
  found.heading = input.scene.marker.heading;
  MeasuredLight& light = found.measured;
  light.evidence.frames = input.samples.frames();
  const auto settle_as_before = [&] {
    light_filter->Recall(input.time, &light, &found.skies);
    return found;
  };
  if (input.day.ToSun().xyz.z <= 0.0) return settle_as_before();
  const StatedHeading stated_heading{input.scene.marker.heading, input.heading_given};
  LightFilter with_heading = *light_filter;
  if (!input.heading_given) {
    const Mat3 stated = scene::MarkerFromWorld(input.scene.marker);
    const auto heading =
        EstimateHeading(input.phantoms, input.samples, stated * Vec3{0.0, 0.0, 1.0},
                        stated * input.day.ToSun().xyz);
    if (heading) with_heading.AddHeading(WeightedHeading(*heading), input.time);
  }
  UseHeading(stated_heading, with_heading, input.time, &found);
  const Fitted fitted = FitAt(input, found.heading);
  const LightPosterior& posterior = fitted.posterior;
  light.evidence.edges = posterior.counted.edges;
  light.evidence.edges_with_contrast = posterior.counted.contrast;
  const bool shines = posterior.sun >= kSure;
  if (shines) {
    *light_filter = with_heading;
  } else {
    // Without a sun the heading was not estimated from shadows.
    UseHeading(stated_heading, *light_filter, input.time, &found);
  }
  if (posterior.clouds >= kSure) {
    light.sun_source = Source::kMeasured;
    light.evidence.edges_agreeing = posterior.counted.edges - posterior.counted.edges_agreeing;
    found.skies.source = OvercastSky();
    found.measured.sun_shines = false;
    light_filter->AddClouds();
    light_filter->Keep(light, found.skies);
    return found;
  }
  light.sun_doubtful = !shines && posterior.elsewhere >= 1 - kSure;
  // Where the sun's position is doubtful, so would be any shade derived from it.
  const bool tells_shade = MayShine(input.scene.cloudiness) && !fitted.cells.empty();
  if (light.sun_doubtful || (!shines && !tells_shade)) return settle_as_before();
  LinearRgb scale{1, 1, 1};
  if (shines && posterior.log_sky_error < kTold * PriorOf(input.scene.cloudiness).log_sky_error) {
    light.sun_source = SourceOf(posterior);
    light.evidence.edges_agreeing = posterior.counted.edges_agreeing;
    if (light.sun_source == Source::kShade)
      light.evidence.shade_places = posterior.counted.shaded_places;
    light_filter->AddSun({Exp(posterior.log_sky), posterior.log_sky_error}, input.time);
  } else if (light_filter->ObservedClouds()) {
    return settle_as_before();
  } else {
    light_filter->RestoreSources(input.time, &light);
  }
  if (const auto known = light_filter->SkyBesideSun(input.time)) {
    scale = known->scale;
    light.sun_to_sky_error = known->relative_error;
    const SkyFit sky = SkyScaledBesideSun(input.day, scale, input.sun.distance_au);
    found.skies = {sky.skies, sky.sky_radiance_scale};
  } else {
    found.skies = {DescribedSky(input.scene)};
  }
  UseShade(input, fitted, scale, &found);
  light_filter->Keep(light, found.skies);
  return found;
}

}  // namespace pleinair::compositor
