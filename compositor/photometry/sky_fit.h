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

/// Sky model fit for a day with measured light.
struct SkyFit {
  std::shared_ptr<const sky::SkySource> skies;
  LinearRgb sky_radiance_scale{1.0, 1.0, 1.0};  ///< Multiplies the sky; the sun stays.
};

/// True if the words of a scene have a sun.
bool MayShine(scene::Cloudiness stated);

/// Skies of the scene description.
std::shared_ptr<const sky::SkySource> DescribedSky(const scene::SceneDescription& scene);
/// The same with a sun, whatever the description. Shadow edges are measured against it.
std::shared_ptr<const sky::SkySource> SunlitSky(const scene::SceneDescription& scene);
std::shared_ptr<const sky::SkySource> OvercastSky();

/// Fits a sky to its light on level ground: `sky_over_sun` times the sun's light on a surface
/// facing it, per channel. Haze and then clouds are added until the luminances agree, so that the
/// sky's shape follows. `sky_radiance_scale` takes the remaining difference per channel.
SkyFit SkyWithShare(LinearRgb sky_over_sun, Direction<World> to_sun, double sun_distance_au);
/// Fits a sky to that of the model `day`, times `scale` beside the sun.
SkyFit SkyScaledBesideSun(const sky::SkyModel& day, LinearRgb scale, double sun_distance_au);

/// Sky by the user's overrides. Returns nothing where they have none.
std::optional<SkyFit> OverriddenSky(const scene::SceneDescription& scene,
                                    const LightOverrides& overrides, const sky::SunPosition& sun);

/// Radiance of the sky beside the sun, relative to SunlitSky().
struct SkyRadianceScale {
  LinearRgb scale{1.0, 1.0, 1.0};
  double relative_error = 0.0;  ///< One standard deviation.
};

/// Combines a measured scale with the description, each weighted by its certainty.
SkyRadianceScale WeightedScale(const SunSkyRatio& estimate, scene::Cloudiness stated);

/// Value to be added to a described heading.
struct HeadingOffset {
  Radians offset;
  Radians error;  ///< One standard deviation.
};

/// Combines a measured heading offset with a compass's uncertainty.
HeadingOffset WeightedHeading(const HeadingEstimate& estimate);

/// Illuminance of level ground by the sun over that by the sky.
double SunToSky(const sky::SkyModel& day);

}  // namespace pleinair::compositor
