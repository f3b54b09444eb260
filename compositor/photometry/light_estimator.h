#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/image.h"
#include "compositor/photometry/light_estimate.h"
#include "compositor/photometry/light_filter.h"
#include "compositor/photometry/light_overrides.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "compositor/photometry/marker/marker_shadow_edge.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/photometry/shade/unmodelled_shadows.h"
#include "compositor/photometry/sky_fit.h"
#include "compositor/photometry/sky_state.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "compositor/photometry/surface_colors.h"
#include "compositor/photometry/surface_samples.h"
#include "scene/scene_description.h"

namespace pleinair::compositor {

/// Estimates heading, sun and sky from the shadows that phantoms cast in frames. All frames share
/// one sun position: that at the first frame's time.
class LightEstimator {
 public:
  /// `scene` has the described or overriding heading.
  LightEstimator(std::shared_ptr<const PhantomRays> phantoms, const CameraModel& camera,
                 const scene::MarkerReflectance& marker_reflectance,
                 const scene::SceneDescription& scene, const LightOverrides& overrides,
                 UtcTime time, const CameraResponse& response);

  /// `shows_marker`: false where the marker is not seen in the frame, so that nothing is measured
  /// on it.
  void Add(CameraImageView image, const Transform<Camera, Marker>& camera_from_marker,
           bool shows_marker = true);
  int frames() const { return samples_.frames(); }

  /// Estimates the light, as far as the overrides leave anything to estimate. Takes one or two
  /// seconds. `light_filter` holds the estimates of earlier passes in the same scene. They
  /// contribute to the result, and this pass's estimates are added to them.
  LightEstimate Estimate(LightFilter* light_filter) const;

  /// Estimates the reflectance of placed models in this light, or in that of the overrides.
  std::map<int, SurfaceColor> MeasureColors(const LightEstimate& found,
                                            const std::set<int>& placed_models) const;

 private:
  /// Estimates the heading, and from the shadow edges at this heading the sun-to-sky ratio.
  SunSkyRatio EstimateHeadingAndRatio(LightFilter* light_filter, LightEstimate* found) const;
  void UseUnmodelledShadows(UnmodelledShadows unmodelled, LightEstimate* found) const;
  /// Returns true if a shadow edge divides the marker in more than single frames. If the scene
  /// description has no sun, the ground must show a shadow edge as well: a marker may be wet or
  /// dirty.
  bool IsMarkerDivided(const UnmodelledShadows& unmodelled) const;
  /// Used where nothing is to be measured: only checks whether unmodelled geometry shades the
  /// ground.
  void UseDescribedLight(LightEstimate* found) const;

  std::shared_ptr<const PhantomRays> phantoms_;
  CameraModel camera_;
  scene::SceneDescription scene_;
  LightOverrides overrides_;
  UtcTime time_;
  sky::SunPosition sun_;
  std::unique_ptr<sky::SkyModel> day_;  // With a sun, even if the scene description has none.
  SurfaceSamples samples_;
  MarkerLightMeter meter_;
  int dappled_ = 0;                                    // Frames in which leaves shade the marker.
  std::vector<MarkerShadowEdge> marker_shadow_edges_;  // One per frame with a divided marker.
  // By the last frame with an exposure estimate; 1 before the first.
  LinearRgb exposure_scale_{1.0, 1.0, 1.0};
};

}  // namespace pleinair::compositor
