#pragma once

#include <memory>
#include <optional>

#include "base/units.h"
#include "base/vector.h"
#include "compositor/photometry/heading_from_shadows.h"
#include "compositor/photometry/light_overrides.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "scene/scene_description.h"
#include "sky/sky_model.h"
#include "sky/sun/sun_position.h"

namespace pleinair::compositor {

/// The skies of a day whose light was measured.
struct SkyFit {
  std::shared_ptr<const sky::SkySource> skies;
  LinearRgb sky_radiance_scale{1.0, 1.0, 1.0};  ///< To multiply the sky with, the sun stays.
};

/// The skies that the scene's words stand for.
std::shared_ptr<const sky::SkySource> DescribedSky(const scene::SceneDescription& scene);
/// The same with a sun, whatever the words: what a shadow's edge is measured against.
std::shared_ptr<const sky::SkySource> SunlitSky(const scene::SceneDescription& scene);
std::shared_ptr<const sky::SkySource> OvercastSky();

/// The sky whose light on level ground, a channel, is `sky_over_sun` times the sun's light on a
/// surface facing it: haze and then clouds are added until the luminances agree, so that the shape
/// of the sky follows; what a channel still lacks goes into `sky_radiance_scale`.
SkyFit SkyWithShare(LinearRgb sky_over_sun, Direction<World> to_sun, double sun_distance_au);
/// The same, of a day's model with the sky so much stronger beside the sun.
SkyFit SkyScaledBesideSun(const sky::SkyModel& day, LinearRgb scale, double sun_distance_au);

/// The sky that the user gives for a sun; nothing where he says nothing of it.
std::optional<SkyFit> OverriddenSky(const scene::SceneDescription& scene,
                                    const LightOverrides& overrides, const sky::SunPosition& sun);

/// How much stronger the sky is beside the sun than SunlitSky() has it.
struct SkyRadianceScale {
  LinearRgb scale{1.0, 1.0, 1.0};
  double relative_error = 0.0;  ///< One standard deviation.
};

/// A measured scale, weighed against how sure the scene's words are.
SkyRadianceScale WeightedScale(const SunSkyRatio& estimate, scene::Cloudiness stated);

/// What is to be added to a stated heading.
struct HeadingOffset {
  Radians offset;
  Radians error;  ///< One standard deviation.
};

/// A measured turn of the heading, weighed against a compass.
HeadingOffset WeightedHeading(const HeadingEstimate& estimate);

/// Sun on level ground over sky.
double SunToSky(const sky::SkyModel& day);

}  // namespace pleinair::compositor
