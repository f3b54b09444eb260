#pragma once

#include "base/utc_time.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/light_estimate.h"
#include "compositor/photometry/light_filter.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "compositor/photometry/surface_samples.h"
#include "scene/scene_description.h"
#include "sky/sky_model.h"
#include "sky/sun/sun_position.h"

namespace pleinair::compositor {

/// Observations and scene description of one moment's light.
struct FittedLightInput {
  const PhantomRays& phantoms;
  const SurfaceSamples& samples;
  const MarkerLightMeter& meter;
  const scene::SceneDescription& scene;
  bool heading_given = false;  ///< The scene's heading is the user's, and holds.
  UtcTime time;
  const sky::SunPosition& sun;
  const sky::SkyModel& day;   ///< With a sun, even if the description has none.
  bool has_exposure = false;  ///< The marker bound the samples' exposure scale.
  bool dappled = false;       ///< Leaves shade the marker in most frames.
};

/// Estimates heading, sun and sky by one fit to all kinds of evidence (light_posterior.h). What
/// counts as observed has a probability of 95 %. Other quantities come from the scene description.
/// `light_filter`: as in LightEstimator::Estimate().
LightEstimate EstimateByFit(const FittedLightInput& input, LightFilter* light_filter);

}  // namespace pleinair::compositor
